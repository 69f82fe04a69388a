#include "render/raytable/table_maker.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/geometry/stone_body.h"
#include "render/raytable/leaf_sink.h"
#include "render/reference/crystal_paths.h"
#include "render/reference/light_paths.h"
#include "render/reference/sampling.h"
#include "render/work/listener.h"
#include "render/work/threads.h"
#include "stone/errors.h"

namespace culet {

namespace {

struct Hit {
    std::uint32_t ray = 0;
    BodyHit entry;
};

class Maker {
public:
    Maker(const Scene& scene, const TableRays& rays, const Progress& progress)
        : scene_(scene),
          rays_(rays),
          body_(scene.stone.solid, scene.stone.convex),
          eyes_(scene.camera),
          pattern_(sample_pattern(rays.samples, rays.setup.on(Effects::aperture),
                                  scene.settings.filter, scene.settings.filter_radius)),
          header_(keys_of(scene, rays)),
          lengths_(static_cast<int>(header_.lengths)),
          // Deep paths keep a transmission that is no denormal number.
          absorption_(1 / (diameter(scene.stone.solid) * std::min(rays.limits.depth, 500))),
          listener_(progress, static_cast<double>(scene.camera.height) *
                                  static_cast<double>(rays.bands.size() + 1)) {
        for (std::size_t f = 0; f < scene.stone.solid.facets.size(); ++f)
            axes_.emplace_back(body_.normal(static_cast<int>(f)));
    }

    RayTable make() {
        find_hits();
        std::vector<std::vector<RowLeaves>> rows;  // of each band
        double remainder = 0, cut = 0;
        for (const Band& band : rays_.bands) {
            rows.push_back(leaves_of(band));
            for (const RowLeaves& row : rows.back()) {
                remainder += row.remainder;
                cut += row.cut;
                header_.deepest =
                    std::max(header_.deepest, static_cast<std::uint32_t>(row.deepest));
            }
        }
        const double paths = std::max(
            1.0, static_cast<double>(parts_.hit_ray.size()) * static_cast<double>(rows.size()));
        header_.remainder = remainder / paths;
        header_.cut = cut / paths;
        put_leaves(rows);
        if (rays_.setup.on(Effects::dispersion)) parts_.wavelengths_nm = rays_.setup.wavelengths_nm;
        return RayTable(header_, parts_);
    }

private:
    const SamplePoint& sample(std::uint32_t ray) const { return pattern_[ray % pattern_.size()]; }
    EyeRay eye_ray(std::uint32_t ray) const {
        const std::uint32_t pixel = ray / static_cast<std::uint32_t>(pattern_.size());
        const auto width = static_cast<std::uint32_t>(scene_.camera.width);
        const SamplePoint& p = sample(ray);
        return eyes_.through(pixel % width + p.x, pixel / width + p.y, p.pupil_x, p.pupil_y);
    }
    // Calls visit(y) for all rows of the picture, on many threads.
    template <class Visit>
    void each_row(Visit&& visit) {
        on_threads(scene_.settings.threads, [&] {
            tbb::parallel_for(0, scene_.camera.height, [&](int y) {
                if (listener_.goes_on() && !too_large_) visit(static_cast<std::size_t>(y));
            });
        });
        if (listener_.stopped()) throw Interrupted();
        if (too_large_) {
            throw InputError(
                fmt::format("a ray table of this scene takes more than {:g} GB: fewer pixels, "
                            "samples or wavelengths, less depth, or a greater cut_weight",
                            k_most_table_bytes / 1e9));
        }
    }

    void find_hits() {
        const auto width = static_cast<std::uint32_t>(scene_.camera.width);
        const auto samples = static_cast<std::uint32_t>(pattern_.size());
        hits_.resize(static_cast<std::size_t>(scene_.camera.height));
        each_row([&](std::size_t y) {
            EntryGuess last;
            const auto row = static_cast<std::uint32_t>(y);
            for (std::uint32_t ray = row * width * samples; ray < (row + 1) * width * samples;
                 ++ray) {
                const SamplePoint& p = sample(ray);
                const std::uint32_t x = ray / samples % width;
                if (!eyes_.sees(x + p.x, row + p.y)) continue;
                const EyeRay eye = eye_ray(ray);
                if (const auto entry = body_.entry(eye.origin, eye.direction, last))
                    hits_[y].push_back({ray, *entry});
            }
        });
        for (const std::vector<Hit>& row : hits_) {
            for (const Hit& hit : row) {
                parts_.hit_ray.push_back(hit.ray);
                parts_.hit_distance.push_back(static_cast<float>(hit.entry.distance));
            }
        }
    }

    std::vector<RowLeaves> leaves_of(const Band& of) {
        std::vector<RowLeaves> rows(hits_.size());
        const Band band = with_lengths(of, lengths_, absorption_);
        const bool general = rays_.setup.splits || !scene_.stone.convex || scene_.immersion != 1;
        // Where paths branch, small leaves are many; a single path keeps all, whose order tells
        // how often they were reflected.
        const double least = header_.branches != 0 ? rays_.limits.cut_weight : 0;
        each_row([&](std::size_t y) {
            RowLeaves& row = rows[y];
            PathTrace trace{};
            LeafSink sink(axes_, lengths_, absorption_, least, row);
            for (const Hit& hit : hits_[y]) {
                row.count.push_back(0);
                const EyeRay eye = eye_ray(hit.ray);
                PathLimits limits = rays_.limits;
                // As the reference has it.
                limits.seed += 0x9e3779b97f4a7c15ull * (static_cast<std::uint64_t>(hit.ray) + 1) +
                               static_cast<std::uint64_t>(of.first);
                if (general) {
                    CrystalPaths<LeafSink> paths(body_, band, limits, sink);
                    const EyeFrame frame = eyes_.frame(eye.direction);
                    paths.trace(eye, frame.x, frame.y, hit.entry);
                } else {
                    LightPaths<LeafSink, false>(body_.planes(), band, limits, sink, trace)
                        .trace(eye, hit.entry);
                }
            }
            leaves_ += static_cast<long long>(row.leaves.size());
            const double bytes =
                static_cast<double>(leaves_) * static_cast<double>(leaf_bytes(header_.lengths));
            if (bytes > k_most_table_bytes) too_large_ = true;
        });
        return rows;
    }

    void put_leaves(const std::vector<std::vector<RowLeaves>>& bands) {
        // Boxes of each facet's leaves, and the longest path.
        constexpr double k_none = std::numeric_limits<double>::infinity();
        std::vector<std::array<double, 4>> box(axes_.size(), {k_none, k_none, -k_none, -k_none});
        double longest = 0;
        each_leaf(bands, [&](const Leaf& leaf) {
            std::array<double, 4>& of = box[static_cast<std::size_t>(leaf.facet)];
            of = {std::min(of[0], leaf.s), std::min(of[1], leaf.t), std::max(of[2], leaf.s),
                  std::max(of[3], leaf.t)};
            longest = std::max({longest, leaf.length[0], leaf.length[1], leaf.length[2]});
        });
        for (std::size_t f = 0; f < axes_.size(); ++f) {
            if (!(box[f][0] <= box[f][2])) box[f] = {};
            parts_.frames.push_back(frame_of(f, box[f]));
        }
        header_.length_step = longest / 65535;
        for (const std::vector<RowLeaves>& rows : bands) {
            std::uint32_t end = static_cast<std::uint32_t>(parts_.weight.size());
            for (const RowLeaves& row : rows) {
                for (const std::uint32_t count : row.count) parts_.leaf_end.push_back(end += count);
                for (const Leaf& leaf : row.leaves)
                    put(leaf, box[static_cast<std::size_t>(leaf.facet)]);
            }
        }
    }
    template <class Visit>
    static void each_leaf(const std::vector<std::vector<RowLeaves>>& bands, Visit&& visit) {
        for (const std::vector<RowLeaves>& rows : bands) {
            for (const RowLeaves& row : rows) {
                for (const Leaf& leaf : row.leaves) visit(leaf);
            }
        }
    }

    FacetFrame frame_of(std::size_t facet, const std::array<double, 4>& box) const {
        const PlaneAxes& axes = axes_[facet];
        const Vec3 corner =
            body_.on_facet(static_cast<int>(facet), box[0] * axes.u + box[1] * axes.v);
        const Vec3 u = (box[2] - box[0]) * axes.u, v = (box[3] - box[1]) * axes.v;
        return {{corner.x, corner.y, corner.z}, {u.x, u.y, u.z}, {v.x, v.y, v.z}};
    }

    void put(const Leaf& leaf, const std::array<double, 4>& box) {
        const auto step = [](double v, double low, double high) {
            return static_cast<std::uint16_t>(
                high > low ? std::lround((v - low) / (high - low) * 65535) : 0);
        };
        parts_.weight.push_back(leaf.weight);
        parts_.facet.push_back(static_cast<std::uint16_t>(leaf.facet));
        for (std::size_t k = 0; k < 2; ++k) parts_.direction[k].push_back(leaf.direction[k]);
        parts_.point[0].push_back(step(leaf.s, box[0], box[2]));
        parts_.point[1].push_back(step(leaf.t, box[1], box[3]));
        for (std::size_t k = 0; k < static_cast<std::size_t>(lengths_); ++k)
            parts_.length[k].push_back(step(leaf.length[k], 0, 65535 * header_.length_step));
    }

    const Scene& scene_;
    const TableRays& rays_;
    StoneBody body_;
    EyeRays eyes_;
    std::vector<SamplePoint> pattern_;
    std::vector<PlaneAxes> axes_;
    RayTableHeader header_;
    int lengths_;
    double absorption_;
    Listener listener_;
    std::vector<std::vector<Hit>> hits_;  // of each row
    std::atomic<long long> leaves_{0};
    std::atomic<bool> too_large_{false};
    RayTableParts<TableVector> parts_;
};

}  // namespace

RayTable make_ray_table(const Scene& scene, const TableRays& rays, const Progress& progress) {
    return Maker(scene, rays, progress).make();
}

}  // namespace culet
