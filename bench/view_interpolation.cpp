#include "bench/view_interpolation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/raytable/table_assembly.h"
#include "render/raytable/table_hits.h"
#include "render/work/listener.h"
#include "render/work/threads.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// A stored view's ray through about a point, with its weight.
struct Source {
    const ViewTable* of = nullptr;
    std::size_t hit = 0;
    double share = 0;
};

// Exits first .. end - 1 of a table.
struct Exits {
    const RayTable* table = nullptr;
    std::uint32_t first = 0, end = 0;
    double share = 0;

    std::span<const std::uint16_t> facets() const {
        return table->parts().facet.subspan(first, end - first);
    }
};

Exits exits_of(const Source& source, std::size_t band) {
    const RayTable& table = source.of->table;
    const auto& ends = table.parts().exits_end;
    const std::size_t at = band * table.header().hits + source.hit;
    return {&table, at == 0 ? 0 : ends[at - 1], ends[at], source.share};
}

class Interpolation {
public:
    Interpolation(const Scene& scene, const TableRays& rays, const std::vector<ViewTable>& tables,
                  const Progress& progress)
        : scene_(scene),
          tables_(tables),
          body_(scene.stone.solid, scene.stone.convex),
          axes_(plane_axes(body_, scene.stone.solid.facets.size())),
          eyes_(scene, rays),
          listener_(progress, scene.camera.height) {
        for (const ViewTable& table : tables) places_.emplace_back(table.view.camera);
        content_.header = keys_of(scene, rays);
        for (const ViewTable& table : tables) {
            content_.header.deepest =
                std::max(content_.header.deepest, table.table.header().deepest);
        }
        const auto& nm = tables.front().table.parts().wavelengths_nm;
        content_.wavelengths_nm.assign(nm.begin(), nm.end());
        content_.bands.resize(rays.bands.size());
    }

    RayTable make() {
        const auto height = static_cast<std::size_t>(scene_.camera.height);
        std::vector<std::vector<TableHit>> hits(height);
        for (std::vector<RowExits>& rows : content_.bands) rows.resize(height);
        on_threads(scene_.settings.threads, [&] {
            tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
                if (!listener_.goes_on()) return;
                hits[y] = eyes_.hits(static_cast<int>(y), body_);
                for (const TableHit& hit : hits[y]) put(hit, y);
            });
        });
        if (listener_.stopped()) throw Interrupted();
        for (const std::vector<TableHit>& row : hits) {
            for (const TableHit& hit : row) {
                content_.hit_ray.push_back(hit.ray);
                content_.hit_distance.push_back(static_cast<float>(hit.entry.distance));
            }
        }
        return assembled(std::move(content_), body_, axes_);
    }

private:
    // Adds the exits in every band.
    void put(const TableHit& hit, std::size_t y) {
        const EyeRay eye = eyes_.ray(hit.ray);
        // Where the ray meets the plane through the middle, perpendicular to the line of sight. Of
        // the planes that were tried, from the front facets to the far side, what is seen inside
        // the stone moves least against this one.
        const Camera& camera = scene_.camera;
        const Vec3 forward = glm::normalize(camera.look_at - camera.position);
        const Vec3 at = eye.origin + glm::dot(camera.look_at - eye.origin, forward) /
                                         glm::dot(eye.direction, forward) * eye.direction;
        std::vector<Source> sources;
        double whole = 0;
        for (std::size_t v = 0; v < tables_.size(); ++v) {
            Source source{&tables_[v], 0, tables_[v].view.share};
            if (!find_ray(v, at, hit.entry.facet, source.hit)) continue;
            whole += source.share;
            sources.push_back(source);
        }
        for (Source& source : sources) source.share /= whole;
        for (std::size_t band = 0; band < content_.bands.size(); ++band) {
            RowExits& row = content_.bands[band][y];
            row.count.push_back(0);
            // Rays that no stored view has are dropped.
            if (sources.empty()) row.cut += 1;
            put_exits(sources, band, row);
        }
    }

    // Prefers a hit with the same front facet.
    bool find_ray(std::size_t v, const Vec3& at, int facet, std::size_t& found) const {
        const RayTable& table = tables_[v].table;
        const std::array<double, 2> place = places_[v].of(at);
        double nearest = 1e300;
        // The pixel itself first, as it is usually the one.
        constexpr int k_around[9][2] = {{0, 0}, {1, 0},  {-1, 0}, {0, 1},  {0, -1},
                                        {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
        for (const auto& [dx, dy] : k_around) {
            const double x = std::floor(place[0]) + dx, y = std::floor(place[1]) + dy;
            if (!(x >= 0 && x < scene_.camera.width && y >= 0 && y < scene_.camera.height))
                continue;
            const double first =
                (y * scene_.camera.width + x) * static_cast<double>(eyes_.pattern().size());
            for (std::size_t k = 0; k < eyes_.pattern().size(); ++k) {
                const SamplePoint& p = eyes_.pattern()[k];
                double away = std::hypot(x + p.x - place[0], y + p.y - place[1]);
                if (away >= nearest) continue;
                const auto ray = static_cast<std::uint32_t>(first + static_cast<double>(k));
                const auto& rays = table.parts().hit_ray;
                const auto hit = std::lower_bound(rays.begin(), rays.end(), ray);
                if (hit == rays.end() || *hit != ray) continue;
                const auto number = static_cast<std::size_t>(hit - rays.begin());
                // Penalty that makes it farther than any hit with the right facet.
                if (front_facet(table, number) != facet) away += 10;
                if (away >= nearest) continue;
                nearest = away;
                found = number;
            }
        }
        return nearest < 1e300;
    }

    // The facet of the first exit, unless that was too faint; -1: none.
    static int front_facet(const RayTable& table, std::size_t hit) {
        const auto& ends = table.parts().exits_end;
        const std::uint32_t first = hit == 0 ? 0 : ends[hit - 1];
        return first < ends[hit] ? table.parts().facet[first] : -1;
    }

    void put_exits(const std::vector<Source>& sources, std::size_t band, RowExits& row) {
        std::vector<Exits> left;
        for (const Source& source : sources) {
            left.push_back(exits_of(source, band));
            row.remainder += source.share * source.of->table.header().remainder;
            row.cut += source.share * source.of->table.header().cut;
        }
        // Merge those that meet the same facets, until none is left.
        while (!left.empty()) {
            const auto others = std::stable_partition(
                left.begin(), left.end(), [first = left.front()](const Exits& more) {
                    return std::ranges::equal(first.facets(), more.facets());
                });
            put_mean({left.begin(), others}, row);
            left.erase(left.begin(), others);
        }
    }

    void put_mean(std::span<const Exits> alike, RowExits& row) {
        double whole = 0;
        for (const Exits& exits : alike) whole += exits.share;
        const std::uint32_t count = alike.front().end - alike.front().first;
        for (std::uint32_t k = 0; k < count; ++k) {
            ExitEvent mean;
            mean.facet = alike.front().facets()[k];
            const PlaneAxes& axes = axes_[static_cast<std::size_t>(mean.facet)];
            Vec3 direction(0), point(0);
            double weight = 0;
            std::array<double, 3> length{};
            for (const Exits& exits : alike) {
                const auto& parts = exits.table->parts();
                const std::size_t exit_event = exits.first + k;
                const double share = exits.share / whole;
                weight += exits.share * static_cast<double>(parts.weight[exit_event]);
                direction += share * octahedral_direction({parts.direction[0][exit_event],
                                                           parts.direction[1][exit_event]});
                point += share * point_of(parts, exit_event);
                for (std::size_t i = 0; i < exits.table->header().lengths; ++i)
                    length[i] +=
                        share * exits.table->header().length_step * parts.length[i][exit_event];
            }
            mean.weight = static_cast<float>(weight);
            mean.direction = octahedral_code(direction);
            mean.s = static_cast<float>(glm::dot(axes.u, point));
            mean.t = static_cast<float>(glm::dot(axes.v, point));
            for (std::size_t i = 0; i < 3; ++i) mean.length[i] = static_cast<float>(length[i]);
            row.exits.push_back(mean);
            ++row.count.back();
        }
    }

    static Vec3 point_of(const RayTableParts<TableSpan>& parts, std::size_t exit_event) {
        const FacetFrame& frame = parts.frames[parts.facet[exit_event]];
        const auto vector = [](const std::array<double, 3>& v) { return Vec3(v[0], v[1], v[2]); };
        return vector(frame.corner) + parts.point[0][exit_event] / 65535.0 * vector(frame.u) +
               parts.point[1][exit_event] / 65535.0 * vector(frame.v);
    }

    const Scene& scene_;
    const std::vector<ViewTable>& tables_;
    StoneBody body_;
    std::vector<PlaneAxes> axes_;
    TableEyes eyes_;
    std::vector<ScreenPlace> places_;
    Listener listener_;
    TableContent content_;
};

}  // namespace

RayTable interpolated(const Scene& scene, const TableRays& rays,
                      const std::vector<ViewTable>& tables, const Progress& progress) {
    return Interpolation(scene, rays, tables, progress).make();
}

}  // namespace culet
