// Relighting, rays off their beams' facets, threads.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bench/beam_bench.h"
#include "render/beams/frame_renderer.h"

namespace culet {

void BeamBench::relighting() {
    tables_.section("relighting",
                    "other lights, same view: the beams are kept; whole: light_with and draw; "
                    "one thread; shade and build are wall time",
                    {"whole ms", "draw ms", "shade ms", "build ms", "new view ms"});
    for (const auto& [name, drawing] : {std::pair{"preview", Drawing::preview},
                                        {"exact", Drawing::exact},
                                        {"anti-aliased", Drawing::averaged}}) {
        FrameRenderer frames(drawn_as(base_, drawing, 1));
        const double anew = frame_time(frames, base_.camera).cpu;
        Clocks draw{1e300, 1e300};
        double shade = 1e300, build = 1e300;
        const Clocks whole = quickest(
            [&] {
                frames.light_with(base_.lights);
                const Clocks start = clocks();
                const RenderStats& stats = frames.draw().stats;
                draw.cpu = std::min(draw.cpu, clocks().cpu - start.cpu);
                shade = std::min(shade, stats.seconds_shade);
                build = std::min(build, stats.seconds_build);
            },
            5, 0.25);
        tables_.line(name, {milliseconds(whole.cpu), milliseconds(draw.cpu), milliseconds(shade),
                            milliseconds(build), milliseconds(anew)});
    }
}

void BeamBench::sequences() {
    constexpr int k_views = 24;
    constexpr unsigned k_seed = 20261;
    tables_.section("sequences",
                    fmt::format("rays of the exact drawing that did not meet their beam's facets "
                                "(traced anew), and area that no beam covers; {} random views, "
                                "seed {}; off: pixels that differ from the reference with 1 sample "
                                "by over 1e-3 of its peak",
                                k_views, k_seed),
                    {"rays", "retraced", "per cent", "lost area", "off"});
    for (const double diameters : {2.5, 6.0, 20.0}) {
        const auto measure = [&](const Vec3& view) {
            Scene scene = base_;
            scene.camera = bench_camera(scene.stone.solid, diameters, view, pixels_);
            return FrameRenderer(drawn_as(scene, Drawing::exact, 0)).draw().stats;
        };
        const auto line = [&](const std::string& what, const RenderStats& s, double lost,
                              const std::string& off) {
            tables_.line(fmt::format("{} diameters, {}", diameters, what),
                         {fmt::format("{}", s.rays), fmt::format("{}", s.retraced),
                          fmt::format("{:.4f}", 100.0 * static_cast<double>(s.retraced) /
                                                    static_cast<double>(s.rays)),
                          fmt::format("{:.1e}", lost), off});
        };
        const RenderStats base = measure(bench_view());
        line("base view", base, base.lost_area, "");
        std::mt19937_64 random(k_seed);
        RenderStats sum, worst;
        double most_lost = 0;
        int off = 0;
        for (int i = 0; i < k_views; ++i) {
            const Vec3 view = random_view(random);
            const RenderStats stats = measure(view);
            sum.rays += stats.rays;
            sum.retraced += stats.retraced;
            most_lost = std::max(most_lost, std::abs(stats.lost_area));
            if (worst.rays == 0 || stats.retraced * worst.rays > worst.retraced * stats.rays)
                worst = stats;
            if (i % 8 == 0) {
                Scene scene = base_;
                scene.camera = bench_camera(scene.stone.solid, diameters, view, pixels_);
                FrameRenderer frames(drawn_as(scene, Drawing::exact, 0));
                off += difference(frames.draw().picture, references_.at(scene, 1)).off;
            }
        }
        line("random views, all", sum, most_lost, fmt::format("{} in 3", off));
        line("random views, worst", worst, worst.lost_area, "");
    }
}

void BeamBench::threads() {
    tables_.section("threads", "base case; speed-up: wall time of one thread over that of two",
                    {"CPU 1", "wall 1", "CPU 2", "wall 2", "speed-up"});
    for (const auto& [name, drawing] : {std::pair{"preview", Drawing::preview},
                                        {"exact", Drawing::exact},
                                        {"anti-aliased", Drawing::averaged}}) {
        FrameRenderer one(drawn_as(base_, drawing, 1)), two(drawn_as(base_, drawing, 2));
        const Clocks a = frame_time(one, base_.camera, 1), b = frame_time(two, base_.camera, 2);
        tables_.line(name, {milliseconds(a.cpu), milliseconds(a.wall), milliseconds(b.cpu),
                            milliseconds(b.wall), fmt::format("{:.2f}", a.wall / b.wall)});
    }
}

}  // namespace culet
