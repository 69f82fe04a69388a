#include "stone/cuts/brilliant.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/solid/plan.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Intersection of the lines of two neighbouring mains.
Vec2 crossing(const Vec2& p, const Vec2& u, const Vec2& q, const Vec2& v) {
    return p + (cross(q - p, v) / cross(u, v)) * u;
}

// Length of the ray from the axis through `y` inside the girdle p - q - r.
double radius_at(const Vec2& y, const Vec2& p, const Vec2& q, const Vec2& r) {
    const Vec2 ray = glm::normalize(y);
    const bool before = cross(ray, q) > 0;  // the ray meets p - q, else q - r
    const Vec2 &from = before ? p : q, &to = before ? q : r;
    return cross(from, to - from) / cross(ray, to - from);
}

struct Builder {
    Solid solid;

    int corner(const Vec2& at, double z) {
        solid.vertices.push_back({at.x, at.y, z});
        return static_cast<int>(solid.vertices.size()) - 1;
    }
    void facet(const std::string& name, std::vector<int> corners) {
        std::vector<Vec3> loop;
        for (int c : corners) loop.push_back(solid.vertices[c]);
        solid.facets.push_back({name, plane_through(loop), std::move(corners)});
    }
};

// Upper and lower girdle corners between a main and a break, or a break and the next main.
struct GirdleStretch {
    std::vector<int> up, low;
    GirdleStretch(int up_from, int up_to, int low_from, int low_to)
        : up{up_from, up_to}, low{low_from, low_to} {}
};

// Beyond the chord the halves continue towards each other. The girdle is thinnest in the middle of
// a stretch ("valley") and has its full height at mains and breaks ("hills").
void add_scallops(Builder& b, GirdleStretch& stretch, const std::vector<Vec2>& arc, int star_meet,
                  int lower_meet) {
    const auto height_on = [&b](int from, int to, int meet, const Vec2& at) {
        const Vec3 p = b.solid.vertices[from];
        const Vec3 n = glm::cross(b.solid.vertices[to] - p, b.solid.vertices[meet] - p);
        return p.z - (n.x * (at.x - p.x) + n.y * (at.y - p.y)) / n.z;
    };
    const int up_from = stretch.up.front(), up_to = stretch.up.back();
    const int low_from = stretch.low.front(), low_to = stretch.low.back();
    const double thickness = b.solid.vertices[up_from].z - b.solid.vertices[low_from].z;
    double thinnest = thickness;
    for (const Vec2& at : arc) {
        const double z_up = height_on(up_from, up_to, star_meet, at);
        const double z_low = height_on(low_from, low_to, lower_meet, at);
        thinnest = std::min(thinnest, z_up - z_low);
        stretch.up.insert(stretch.up.end() - 1, b.corner(at, z_up));
        stretch.low.insert(stretch.low.end() - 1, b.corner(at, z_low));
    }
    if (!(thinnest > 1e-3 * thickness)) {
        throw InputError(
            fmt::format("a round girdle {:.3g} mm thick at the mains vanishes between: make it "
                        "thicker than {:.3g} mm, or leave it one facet under each half",
                        thickness, thickness - thinnest));
    }
}

std::string numbered(const char* letter, std::size_t i) {
    return fmt::format("{}{}", letter, i + 1);
}

// Cuts the pavilion mains off level.
Solid cut_culet(const Solid& solid, double level) {
    std::vector<NamedPlane> planes;
    for (const Facet& facet : solid.facets) planes.push_back({facet.name, facet.plane});
    planes.push_back({"CU", {{0, 0, -1}, -level}});
    const Solid raw = intersect_half_spaces(planes).solid;
    return contract_near_meets(raw, 1e-9 * diameter(raw)).solid;
}

struct Corners {
    // One for every main, or for the edge between it and the next.
    std::vector<int> table, star_meet, main_up, break_up, main_low, break_low, lower_meet;
    int notch_table = -1, culet = -1;
};

Corners add_corners(Builder& b, const Outline& outline, const BrilliantProportions& p) {
    const std::size_t k = outline.mains.size();
    const double z_up = p.girdle / 2, z_low = -z_up;
    const double z_table = z_up + p.crown_height, z_culet = z_low - p.pavilion_depth;
    Corners c;
    for (std::size_t i = 0; i < k; ++i) {
        const std::size_t next = (i + 1) % k;
        // The girdle's crossing is the table's enlarged, so from above both lie on a ray from the
        // axis; the edge between two mains lies over it.
        const Vec2 y = crossing(outline.mains[i], outline.tangents[i], outline.mains[next],
                                outline.tangents[next]);
        const double y_radius = glm::length(y);
        const double girdle_radius =
            radius_at(y, outline.mains[i], outline.breaks[i], outline.mains[next]);
        const double table_radius = p.table * y_radius;
        const double star_radius = table_radius + p.star * (girdle_radius - table_radius);
        const double along = (star_radius / y_radius - p.table) / (1 - p.table);
        const double low_radius = (1 - p.lower_half) * girdle_radius;
        if (!(girdle_radius > table_radius && along > 0 && star_radius < girdle_radius)) {
            throw InputError(
                fmt::format("stars and a table of {:.0f} % leave no room for the upper halves: "
                            "make the table smaller or the "
                            "star longer",
                            100 * p.table));
        }
        c.table.push_back(b.corner(p.table * outline.mains[i], z_table));
        if (static_cast<int>(i) == outline.notch) c.notch_table = b.corner(p.table * y, z_table);
        c.star_meet.push_back(
            b.corner((star_radius / y_radius) * y, z_table - along * p.crown_height));
        c.main_up.push_back(b.corner(outline.mains[i], z_up));
        c.break_up.push_back(b.corner(outline.breaks[i], z_up));
        c.main_low.push_back(b.corner(outline.mains[i], z_low));
        c.break_low.push_back(b.corner(outline.breaks[i], z_low));
        const double t = low_radius / y_radius;
        c.lower_meet.push_back(b.corner(t * y, z_culet + t * p.pavilion_depth));
    }
    c.culet = b.corner({0, 0}, z_culet);
    return c;
}

std::vector<GirdleStretch> girdle_stretches(Builder& b, const Outline& outline, const Corners& c) {
    const std::size_t k = c.table.size();
    std::vector<GirdleStretch> stretches;
    for (std::size_t i = 0; i < k; ++i) {
        const std::size_t next = (i + 1) % k;
        stretches.push_back({c.main_up[i], c.break_up[i], c.main_low[i], c.break_low[i]});
        stretches.push_back({c.break_up[i], c.main_up[next], c.break_low[i], c.main_low[next]});
    }
    for (std::size_t j = 0; j < outline.arcs.size(); ++j) {
        add_scallops(b, stretches[j], outline.arcs[j], c.star_meet[j / 2], c.lower_meet[j / 2]);
    }
    return stretches;
}

void add_crown(Builder& b, int notch, const Corners& c,
               const std::vector<GirdleStretch>& stretches) {
    const std::size_t k = c.table.size();
    std::vector<int> table_loop;
    for (std::size_t i = 0; i < k; ++i) {
        table_loop.push_back(c.table[i]);
        if (static_cast<int>(i) == notch) table_loop.push_back(c.notch_table);
    }
    b.facet("T", table_loop);
    for (std::size_t i = 0; i < k; ++i) {
        if (static_cast<int>(i) == notch) continue;  // two mains meet in a valley: no star
        b.facet(numbered("S", i), {c.table[i], c.star_meet[i], c.table[(i + 1) % k]});
    }
    for (std::size_t i = 0; i < k; ++i) {
        const std::size_t before = (i + k - 1) % k;
        std::vector<int> loop{c.table[i]};
        if (static_cast<int>(before) == notch) loop.push_back(c.notch_table);
        loop.insert(loop.end(), {c.star_meet[before], c.main_up[i], c.star_meet[i]});
        if (static_cast<int>(i) == notch) loop.push_back(c.notch_table);
        b.facet(numbered("C", i), loop);
    }
    for (std::size_t i = 0; i < k; ++i) {
        for (const std::size_t j : {2 * i, 2 * i + 1}) {
            std::vector<int> loop = stretches[j].up;
            loop.insert(loop.begin(), c.star_meet[i]);
            b.facet(numbered("U", j), loop);
        }
    }
}

void add_girdle(Builder& b, const std::vector<GirdleStretch>& stretches) {
    std::size_t girdle_facets = 0;
    for (const GirdleStretch& stretch : stretches) {
        for (std::size_t s = 0; s + 1 < stretch.up.size(); ++s) {
            b.facet(numbered("G", girdle_facets++),
                    {stretch.up[s], stretch.low[s], stretch.low[s + 1], stretch.up[s + 1]});
        }
    }
}

void add_pavilion(Builder& b, const Corners& c, const std::vector<GirdleStretch>& stretches) {
    const std::size_t k = c.table.size();
    for (std::size_t i = 0; i < k; ++i) {
        for (const std::size_t j : {2 * i, 2 * i + 1}) {
            std::vector<int> loop(stretches[j].low.rbegin(), stretches[j].low.rend());
            loop.push_back(c.lower_meet[i]);
            b.facet(numbered("L", j), loop);
        }
    }
    for (std::size_t i = 0; i < k; ++i) {
        b.facet(numbered("P", i),
                {c.main_low[i], c.lower_meet[(i + k - 1) % k], c.culet, c.lower_meet[i]});
    }
}

Solid with_culet(const Solid& solid, const Corners& c, const BrilliantProportions& p) {
    const double z_culet = solid.vertices[c.culet].z;
    double deepest = 0;  // depth of the lower halves' meets / the pavilion's depth
    for (const int meet : c.lower_meet) {
        deepest = std::max(deepest, 1 - (solid.vertices[meet].z - z_culet) / p.pavilion_depth);
    }
    if (!(p.culet < 1 - deepest)) {
        throw InputError(fmt::format(
            "a culet of {:.1f} % cuts into the lower halves; with these at most {:.1f} %",
            100 * p.culet, 100 * (1 - deepest)));
    }
    return cut_culet(solid, z_culet + p.culet * p.pavilion_depth);
}

}  // namespace

double star_of_length(double star_length, double table, int mains) {
    const double c = std::cos(std::numbers::pi / mains);
    const double edge = table * c, meeting = table / c;
    const double star = (edge + star_length * (1 - edge) - meeting) / (1 - meeting);
    const double shortest = (meeting - edge) / (1 - edge);
    if (!(meeting < 1)) {
        throw InputError(
            fmt::format("a table of {:.4g} % swallows the crown mains: expected less "
                        "than {:.4g} %",
                        100 * table, 100 * c));
    }
    if (!(star > 0)) {
        throw InputError(
            fmt::format("star length {:.4g} % with table {:.4g} % leaves no room for "
                        "the crown mains: expected {:.4g} to 100 %",
                        100 * star_length, 100 * table, 100 * shortest));
    }
    return star;
}

Solid brilliant(const Outline& outline, const BrilliantProportions& p) {
    Builder b;
    const Corners c = add_corners(b, outline, p);
    const std::vector<GirdleStretch> stretches = girdle_stretches(b, outline, c);
    add_crown(b, outline.notch, c, stretches);
    add_girdle(b, stretches);
    add_pavilion(b, c, stretches);
    return p.culet > 0 ? with_culet(b.solid, c, p) : b.solid;
}

}  // namespace culet
