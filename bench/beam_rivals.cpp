// The beams beside a plain ray tracer and POV-Ray.

#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "bench/beam_bench.h"
#include "bench/plain_tracer.h"
#include "bench/povray_run.h"
#include "render/beams/frame_renderer.h"

namespace culet {

namespace {

struct TracedPoint {
    double rmse, seconds, samples;
};

}  // namespace

void BeamBench::plain() {
    tables_.section("plain tracer",
                    fmt::format("packets of rays without beams, one thread; errors against {} "
                                "samples, of which {} would be too noisy here; off: as above",
                                k_finest, k_full),
                    {"CPU ms", "RMSE", "PSNR", "off"});
    for (const bool polarised : {false, true}) {
        Scene scene = base_;
        set_polarised(scene, polarised);
        equal_error(scene, polarised ? "polarised, " : "unpolarised, ");
    }
}

// The time that each renderer needs for the beams' error.
void BeamBench::equal_error(const Scene& scene, const std::string& of) {
    const PlainTracer tracer(scene);
    const Picture& reference = references_.at(scene, k_finest);
    const auto trace = [&](const PlainTracing& how, const std::string& what) {
        Picture picture;
        const double took =
            quickest([&] { tracer.draw(how, picture); }, how.across < 4 ? 4 : 2, 0).cpu;
        const Difference d = difference(picture, reference);
        const std::string off =
            how.across > 1 ? ""
                           : fmt::format("{}", difference(picture, references_.at(scene, 1)).off);
        tables_.line(of + what, {milliseconds(took), fmt::format("{:.2e}", d.rmse),
                                 fmt::format("{:.1f}", d.psnr()), off});
        return TracedPoint{d.rmse, took, static_cast<double>(how.across * how.across)};
    };
    PlainTracing how;
    how.polarised = scene.settings.effects[static_cast<std::size_t>(Effects::polarization)];
    how.search = ExitSearch::every_plane;
    trace(how, "1 sample, every plane");
    how.search = ExitSearch::walk;
    std::vector<TracedPoint> points;
    for (const int across : {1, 2, 3, 4, 5, 6, 8, 12, 16, 24}) {
        how.across = across;
        points.push_back(
            trace(how, fmt::format("{} sample{}", across * across, across == 1 ? "" : "s")));
    }
    for (const auto& [name, drawing] :
         {std::pair{"preview", Drawing::preview}, {"anti-aliased beams", Drawing::averaged}}) {
        FrameRenderer frames(drawn_as(scene, drawing, 1));
        const double beams = frame_time(frames, scene.camera).cpu;
        const Difference d = difference(frames.draw().picture, reference);
        // Linear interpolation of logarithms; beyond the ends the nearest line is extended.
        std::size_t i = 0;
        while (i + 2 < points.size() && points[i + 1].rmse > d.rmse) ++i;
        const TracedPoint &a = points[i], &b = points[i + 1];
        const double t = std::log(d.rmse / a.rmse) / std::log(b.rmse / a.rmse);
        const auto between = [&](double from, double to) { return from * std::pow(to / from, t); };
        const double seconds = between(a.seconds, b.seconds);
        tables_.line(of + name, {milliseconds(beams), fmt::format("{:.2e}", d.rmse),
                                 fmt::format("{:.1f}", d.psnr()), ""});
        tables_.remark(fmt::format(
            "  the plain tracer comes to that error with {:.1f} samples a pixel in {} ms: {:.1f} "
            "times the beams' time{}",
            between(a.samples, b.samples), milliseconds(seconds), seconds / beams,
            t < 0 || t > 1 ? " (extrapolated)" : ""));
    }
}

void BeamBench::povray() {
    constexpr int k_level = 8;
    tables_.section(
        "POV-Ray",
        fmt::format("max_trace_level {}, +A0.1 +AM2 +R3, one thread, seconds of tracing; "
                    "lights of 0.9 at most, because a PNG holds no more than 1; "
                    "errors against {} samples of the reference (POV-Ray: unpolarised)",
                    k_level, k_full),
        {"CPU s", "RMSE", "PSNR", "POV-Ray/it"});
    if (!povray_is_installed()) {
        tables_.remark("povray is not installed");
        return;
    }
    Scene scene = base_;
    scene.settings.depth = k_level - 1;
    scene.lights = smooth_lights(0.9);
    beside_povray("distant lights", scene);
    scene.lights = near_lights(diameter(scene.stone.solid));
    beside_povray("near lights", scene);
}

void BeamBench::beside_povray(const std::string& lights, Scene scene) {
    const PovrayRun theirs = PovrayFolder().draw(scene, "+A0.1 +AM2 +R3", 1);
    const auto line = [&](const std::string& what, double seconds, const Picture& picture) {
        const Difference d = difference(picture, references_.at(scene, k_full));
        tables_.line(
            lights + ", " + what,
            {fmt::format("{:.4f}", seconds), fmt::format("{:.2e}", d.rmse),
             fmt::format("{:.1f}", d.psnr()), fmt::format("{:.0f}", theirs.seconds / seconds)});
    };
    line("POV-Ray", theirs.seconds, theirs.picture);
    for (const bool polarised : {false, true}) {
        set_polarised(scene, polarised);
        for (const auto& [name, drawing, tolerance] :
             {std::tuple{"preview", Drawing::preview, 0.0},
              {"anti-aliased, tolerance 0.01", Drawing::averaged, 0.01},
              {"anti-aliased, tolerance 0", Drawing::averaged, 0.0}}) {
            Scene drawn = drawn_as(scene, drawing, 1);
            drawn.settings.tolerance = tolerance;
            FrameRenderer frames(drawn);
            const double seconds = frame_time(frames, scene.camera).cpu;
            line(fmt::format("{}, {}", polarised ? "polarised" : "unpolarised", name), seconds,
                 frames.draw().picture);
        }
    }
}

}  // namespace culet
