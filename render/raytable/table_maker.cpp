#include "render/raytable/table_maker.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/raytable/table_assembly.h"
#include "render/raytable/table_hits.h"
#include "render/reference/crystal_paths.h"
#include "render/reference/light_paths.h"
#include "render/work/listener.h"
#include "render/work/threads.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

class Maker {
public:
    Maker(const Scene& scene, const TableRays& rays, const Progress& progress)
        : scene_(scene),
          rays_(rays),
          body_(scene.stone.solid, scene.stone.convex),
          axes_(plane_axes(body_, scene.stone.solid.facets.size())),
          eyes_(scene, rays),
          lengths_(rays.setup.splits ? 3 : 1),
          branches_(paths_branch(scene, rays.setup)),
          // Keeps the transmission of deep paths above the denormal range.
          absorption_(1 / (diameter(scene.stone.solid) * std::min(rays.limits.depth, 500))),
          listener_(progress, static_cast<double>(scene.camera.height) *
                                  static_cast<double>(rays.bands.size() + 1)) {
        content_.header = keys_of(scene, rays);
    }

    RayTable make() {
        find_hits();
        for (const Band& band : rays_.bands) content_.bands.push_back(exits_of(band));
        if (rays_.setup.on(Effects::dispersion))
            content_.wavelengths_nm = rays_.setup.wavelengths_nm;
        return assembled(std::move(content_), body_, axes_);
    }

private:
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

    void watch_size(long long exits) {
        const std::size_t bytes = exit_bytes(static_cast<unsigned>(lengths_));
        if (static_cast<double>(exits) * static_cast<double>(bytes) > k_most_table_bytes)
            too_large_ = true;
    }

    void find_hits() {
        hits_.resize(static_cast<std::size_t>(scene_.camera.height));
        // Each hit has at least one exit event per band.
        std::atomic<long long> count{0};
        each_row([&](std::size_t y) {
            hits_[y] = eyes_.hits(static_cast<int>(y), body_);
            count += static_cast<long long>(hits_[y].size() * rays_.bands.size());
            watch_size(count);
        });
        for (const std::vector<TableHit>& row : hits_) {
            for (const TableHit& hit : row) {
                content_.hit_ray.push_back(hit.ray);
                content_.hit_distance.push_back(static_cast<float>(hit.entry.distance));
            }
        }
    }

    std::vector<RowExits> exits_of(const Band& of) {
        std::vector<RowExits> rows(hits_.size());
        const Band band = with_lengths(of, lengths_, absorption_);
        const bool general = rays_.setup.splits || !scene_.stone.convex || scene_.immersion != 1;
        // Branching paths have many small exit events. A single path keeps all of them, as their
        // order gives the number of reflections.
        const double least = branches_ ? rays_.limits.cut_weight : 0;
        each_row([&](std::size_t y) {
            RowExits& row = rows[y];
            PathTrace trace{};
            ExitSink sink(axes_, lengths_, absorption_, least, row);
            for (const TableHit& hit : hits_[y]) {
                if (!listener_.still_goes_on()) return;
                row.count.push_back(0);
                const EyeRay eye = eyes_.ray(hit.ray);
                PathLimits limits = rays_.limits;
                limits.seed += 0x9e3779b97f4a7c15ull * (static_cast<std::uint64_t>(hit.ray) + 1) +
                               static_cast<std::uint64_t>(of.first);
                if (general) {
                    CrystalPaths<ExitSink> paths(body_, band, limits, sink);
                    const EyeFrame frame = eyes_.frame(eye.direction);
                    paths.trace(eye, frame.x, frame.y, hit.entry);
                } else {
                    LightPaths<ExitSink, false>(body_.planes(), band, limits, sink, trace)
                        .trace(eye, hit.entry);
                }
            }
            exits_ += static_cast<long long>(row.exits.size());
            watch_size(exits_);
        });
        return rows;
    }

    const Scene& scene_;
    const TableRays& rays_;
    StoneBody body_;
    std::vector<PlaneAxes> axes_;
    TableEyes eyes_;
    int lengths_;
    bool branches_;
    double absorption_;
    Listener listener_;
    std::vector<std::vector<TableHit>> hits_;  // per row
    std::atomic<long long> exits_{0};
    std::atomic<bool> too_large_{false};
    TableContent content_;
};

}  // namespace

RayTable make_ray_table(const Scene& scene, const TableRays& rays, const Progress& progress) {
    return Maker(scene, rays, progress).make();
}

}  // namespace culet
