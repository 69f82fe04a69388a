// Mountings of every cut: metal that holds the stone without touching it. Expectations: exact tests
// of intersection (CGAL), Euler's formula, laws of geometry.

#include "stone/setting/setting.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <ostream>

#include "stone/cuts/cuts.h"
#include "stone/setting/gap.h"
#include "stone/solid/facet_triangles.h"
#include "stone/text/errors.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Triangle_3 exact(const Triangle& t) {
    const auto point = [](const Vec3& v) { return Kernel::Point_3(v.x, v.y, v.z); };
    return {point(t[0]), point(t[1]), point(t[2])};
}

std::vector<Triangle> triangles_of(const Solid& solid) {
    std::vector<Triangle> triangles;
    for (const Facet& facet : solid.facets) {
        for (const auto& t : facet_triangles(solid, facet))
            triangles.push_back({solid.vertices[t[0]], solid.vertices[t[1]], solid.vertices[t[2]]});
    }
    return triangles;
}

bool boxes_meet(const Triangle& a, const Triangle& b) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto low = [axis](const Triangle& t) {
            return std::min({t[0][axis], t[1][axis], t[2][axis]});
        };
        const auto high = [axis](const Triangle& t) {
            return std::max({t[0][axis], t[1][axis], t[2][axis]});
        };
        if (low(a) > high(b) || low(b) > high(a)) return false;
    }
    return true;
}

// Exact test: some triangle of the metal intersects the stone's surface.
bool meets(const Solid& metal, const std::vector<Triangle>& stone) {
    for (const Triangle& m : triangles_of(metal)) {
        for (const Triangle& s : stone) {
            if (boxes_meet(m, s) && CGAL::do_intersect(exact(m), exact(s))) return true;
        }
    }
    return false;
}

// The winding number of a surface about a point: the solid angle of its triangles over 4 pi (van
// Oosterom and Strackee 1983); 1 inside and 0 outside.
double winding(const std::vector<Triangle>& surface, const Vec3& point) {
    double angle = 0;
    for (const Triangle& t : surface) {
        const Vec3 a = t[0] - point, b = t[1] - point, c = t[2] - point;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        angle += 2 * std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                                   glm::dot(b, c) * la +
                                                                   glm::dot(c, a) * lb);
    }
    return angle / (4 * M_PI);
}

double volume_of_part(const Shell& shell) {
    double volume = 0;
    for (const auto& t : shell.triangles)
        volume +=
            glm::dot(shell.vertices[t[0]], glm::cross(shell.vertices[t[1]], shell.vertices[t[2]])) /
            6;
    return volume;
}

struct Mounting {
    std::string cut;
    SettingStyle style = SettingStyle::prong;
    std::map<std::string, double> values = {};
    friend void PrintTo(const Mounting& one, std::ostream* out) { *out << one.cut; }
};

class EveryMounting : public testing::TestWithParam<Mounting> {
protected:
    void SetUp() override {
        stone_ = make_cut(GetParam().cut, GetParam().values);
        SettingOptions options;
        options.style = GetParam().style;
        setting_ = make_setting(stone_, {0, 0, 1}, options);
    }
    Solid stone_;
    Setting setting_;
};

TEST_P(EveryMounting, IsClosedShellsThatFaceOutward) {
    for (const SettingPart& part : setting_.parts) {
        EXPECT_TRUE(is_closed(part.shell)) << part.name;
        EXPECT_GT(volume_of_part(part.shell), 0) << part.name;
        // Euler: 2 for a wire with ends, 0 for a ring. Each edge has two triangles.
        const auto faces = static_cast<int>(part.shell.triangles.size());
        const int euler = static_cast<int>(part.shell.vertices.size()) - faces / 2;
        const bool is_ring = !part.name.starts_with("prong") && !part.name.starts_with("leg");
        EXPECT_EQ(euler, is_ring ? 0 : 2) << part.name;
    }
}

TEST_P(EveryMounting, DoesNotTouchTheStoneAndIsAsNearAsItSays) {
    const std::vector<Triangle> stone = triangles_of(stone_);
    EXPECT_FALSE(meets(mesh_of(setting_), stone));
    const double clearance = *setting_.options.clearance, wire = *setting_.options.prong_diameter;
    EXPECT_GE(setting_.clearance, clearance);
    for (const SettingPart& part : setting_.parts) {
        EXPECT_NEAR(winding(stone, part.shell.vertices[0]), 0, 1e-9) << part.name;
        EXPECT_NEAR(winding(stone, part.shell.vertices.back()), 0, 1e-9) << part.name;
        EXPECT_GE(part.gap, clearance) << part.name;
        // Holding parts come as near as the clearance (setting.h: to a thousandth of the wire).
        if (part.name.starts_with("prong") || part.name == "bezel") {
            EXPECT_LE(part.gap, clearance + 1e-3 * wire) << part.name;
        }
    }
}

// A held stone cannot leave: moved by an eighth of the wire, up, down or sideways, it meets metal.
// That is far more than a clearance of 1/62 of the wire and the facets' slack.
TEST_P(EveryMounting, HoldsTheStone) {
    const double step = *setting_.options.prong_diameter / 8;
    const Solid metal = mesh_of(setting_);
    std::vector<Vec3> ways{{0, 0, 1}, {0, 0, -1}};
    for (int i = 0; i < 8; ++i)
        ways.emplace_back(std::cos(i * M_PI / 4), std::sin(i * M_PI / 4), 0);
    for (const Vec3& way : ways) {
        Solid moved = stone_;
        for (Vec3& vertex : moved.vertices) vertex += step * way;
        EXPECT_TRUE(meets(metal, triangles_of(moved))) << way.x << " " << way.y << " " << way.z;
    }
}

std::vector<Mounting> mountings() {
    std::vector<Mounting> all;
    for (const CutKind& kind : cut_kinds()) {
        all.push_back({kind.name, SettingStyle::prong});
        all.push_back({kind.name, SettingStyle::bezel});
    }
    // A steep pavilion, a flat crown, a thick girdle.
    all.push_back({"round-brilliant", SettingStyle::prong, {{"girdle", 10}}});
    all.push_back({"step", SettingStyle::bezel, {{"ratio", 2.2}}});
    all.push_back({"oval", SettingStyle::prong, {{"ratio", 2}}});
    return all;
}

std::string name_of_mounting(const testing::TestParamInfo<Mounting>& made) {
    std::string name = made.param.cut;
    if (made.param.style == SettingStyle::bezel) name += "_bezel";
    for (const auto& value : made.param.values) name += "_" + value.first;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Cuts, EveryMounting, testing::ValuesIn(mountings()), name_of_mounting);

TEST(Setting, IsTheSameForAStoneThatLiesAnyhowAndInAnyUnit) {
    // A stone that is turned, scaled and shifted has the same mounting, moved likewise: the gaps
    // scale. A turn of the frame mixes rounding errors of 1e-16 of 100 lengths.
    const Solid stone = make_cut("oval");
    SettingOptions options;
    options.smoothness = 12;
    const Setting setting = make_setting(stone, {0, 0, 1}, options);
    for (const double scale : {1e-3, 1e3}) {
        SettingOptions scaled = options;
        scaled.ring_diameter *= scale;
        const Solid other = test::moved(stone, scale, Vec3(3, -2, 5) * scale, false);
        const Setting same = make_setting(other, {0, 0, 1}, scaled);
        ASSERT_EQ(same.parts.size(), setting.parts.size());
        EXPECT_NEAR(same.clearance / scale, setting.clearance, 1e-9);
        EXPECT_NEAR((same.high.z - same.low.z) / scale, setting.high.z - setting.low.z, 1e-9);
    }
    const Solid turned = test::moved(stone, 1, {0, 0, 0});
    const Setting upright =
        make_setting(turned, turned.facets[find_facet(turned, "T")].plane.normal, options);
    EXPECT_NEAR(upright.clearance, setting.clearance, 1e-3 * *setting.options.prong_diameter);
    EXPECT_FALSE(meets(mesh_of(upright), triangles_of(turned)));
}

TEST(Setting, RefusesWhatDoesNotGoTogether) {
    const Solid stone = make_cut("round-brilliant");
    const auto set = [&stone](auto change) {
        SettingOptions options;
        change(options);
        return make_setting(stone, {0, 0, 1}, options);
    };
    EXPECT_THROW(set([](auto& o) { o.prong_diameter = 5; }), InputError);
    EXPECT_THROW(set([](auto& o) { o.clearance = 0; }), InputError);
    EXPECT_THROW(set([](auto& o) { o.clearance = 2; }), InputError);
    EXPECT_THROW(set([](auto& o) { o.ring_diameter = 0.5; }), InputError);
    EXPECT_THROW(make_setting(Solid{}, {0, 0, 1}, {}), InputError);
}

TEST(Setting, HasTheRingThatWasAskedFor) {
    SettingOptions options;
    options.ring_diameter = 19;
    const Setting setting = make_setting(make_cut("round-brilliant"), {0, 0, 1}, options);
    // The finger's hole: no vertex of the shank is nearer to its middle than the radius, less the
    // sagitta of the chords, and some vertex is that near.
    const auto shank = std::find_if(setting.parts.begin(), setting.parts.end(),
                                    [](const SettingPart& part) { return part.name == "shank"; });
    ASSERT_NE(shank, setting.parts.end());
    Vec3 low(1e9), high(-1e9);
    for (const Vec3& v : shank->shell.vertices) {
        low = glm::min(low, v);
        high = glm::max(high, v);
    }
    const Vec3 middle = 0.5 * (low + high);
    double nearest = 1e9;
    for (const Vec3& v : shank->shell.vertices)
        nearest = std::min(nearest, std::hypot(v.y - middle.y, v.z - middle.z));
    // Mitres move vertices by 1 - 1 / cos(half the turn) of the wire's radius: 144 steps, 1 mm.
    EXPECT_NEAR(nearest, 9.5, 1.0 * (1 / std::cos(M_PI / 144) - 1));
}

}  // namespace
}  // namespace culet
