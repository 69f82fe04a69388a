#include "bench/beam_bench.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/beams/frame_renderer.h"
#include "stone/text/errors.h"

namespace culet {

std::string milliseconds(double seconds) {
    return fmt::format("{:.2f}", 1e3 * seconds);
}

void BeamBench::begin(const std::string& name, const std::string& remark) {
    tables_.section(name, remark,
                    {"CPU ms", "wall ms", "pictures/s", "beams", "retraced", "lost area", "RMSE",
                     "PSNR", "error", "reported", "off"});
}

void BeamBench::all_drawings(const std::string& what, const Scene& scene, int samples) {
    drawing(what + ", preview", scene, Drawing::preview, samples);
    drawing(what + ", exact", scene, Drawing::exact, samples);
    drawing(what + ", anti-aliased", scene, Drawing::averaged, samples);
}

// A line of the table; CPU time on one thread, wall time on all.
void BeamBench::drawing(const std::string& what, const Scene& scene, Drawing kind, int samples) {
    FrameRenderer one(drawn_as(scene, kind, 1)), all(drawn_as(scene, kind, 0));
    const Clocks took{frame_time(one, scene.camera).cpu, frame_time(all, scene.camera).wall};
    one.look_from(scene.camera);
    const RenderResult& result = one.draw(true);
    const RenderStats& stats = result.stats;
    const Difference d = difference(result.picture, references_.at(scene, samples));
    // With one ray per pixel, it must be the reference's ray.
    const bool single = kind == Drawing::exact && scene.camera.aperture_radius == 0;
    const Difference promised = single ? difference(result.picture, references_.at(scene, 1)) : d;
    tables_.line(what, {milliseconds(took.cpu), milliseconds(took.wall),
                        fmt::format("{:.1f}", 1 / took.wall), fmt::format("{}", stats.beams),
                        fmt::format("{}", stats.retraced), fmt::format("{:.1e}", stats.lost_area),
                        fmt::format("{:.2e}", d.rmse), fmt::format("{:.1f}", d.psnr()),
                        fmt::format("{:.2e}", promised.of_stone / stats.mean_radiance),
                        fmt::format("{:.2e}", stats.engine_error),
                        single ? fmt::format("{}", promised.off) : std::string()});
    if (promised.of_stone > stats.engine_error * stats.mean_radiance)
        tables_.remark("  the error is over the reported one");
}

void BeamBench::reference(int samples) {
    Scene scene = base_;
    scene.settings.samples = samples;
    scene.settings.threads = 1;
    Picture picture;
    const Clocks one = quickest([&] { picture = render(scene).picture; }, samples == 1 ? 2 : 1, 0);
    scene.settings.threads = 0;
    const Clocks all = quickest([&] { picture = render(scene).picture; }, samples == 1 ? 2 : 1, 0);
    const Difference d = difference(picture, references_.at(base_, k_full));
    tables_.line(
        fmt::format("reference, {} sample{}", samples, samples == 1 ? "" : "s"),
        {milliseconds(one.cpu), milliseconds(all.wall), fmt::format("{:.2f}", 1 / all.wall), "", "",
         "", fmt::format("{:.2e}", d.rmse), fmt::format("{:.1f}", d.psnr()), "", "", ""});
}

void BeamBench::engines() {
    const Picture& picture = references_.at(base_, k_full);
    const Difference d = difference(picture, picture);
    begin(
        "engines",
        fmt::format("base case; errors against {} samples, whose largest radiance is {:.3f}, mean "
                    "{:.3f}",
                    k_full, d.peak, d.mean));
    all_drawings("unpolarised", base_, k_full);
    reference(1);
    reference(16);
    Scene polarised = base_;
    set_polarised(polarised, true);
    all_drawings("polarised", polarised, k_full);
}

void BeamBench::depths() {
    begin("depth", fmt::format("errors against {} samples (8: {})", k_side, k_full));
    for (int depth = 2; depth <= 12; depth += 2) {
        Scene scene = base_;
        scene.settings.depth = depth;
        all_drawings(fmt::format("depth {}", depth), scene, depth == 8 ? k_full : k_side);
    }
}

void BeamBench::stones() {
    begin("facets", fmt::format("errors against {} samples (73: {})", k_side, k_full));
    for (const BenchStone& stone : bench_stones()) {
        Scene scene = base_;
        scene.stone.solid = stone.solid;
        scene.camera = bench_camera(stone.solid, 6, bench_view(), pixels_);
        all_drawings(stone.name, scene, stone.solid.facets.size() == 73 ? k_full : k_side);
    }
}

void BeamBench::distances() {
    begin("distance", fmt::format("errors against {} samples (6: {})", k_side, k_full));
    for (const double diameters : {2.5, 6.0, 20.0}) {
        Scene scene = base_;
        scene.camera = bench_camera(scene.stone.solid, diameters, bench_view(), pixels_);
        all_drawings(fmt::format("{} diameters", diameters), scene,
                     diameters == 6 ? k_full : k_side);
    }
}

void BeamBench::wavelengths() {
    begin("wavelengths",
          fmt::format("polarised, dispersion; errors against {} samples (1: {})", k_side, k_full));
    for (const int count : {1, 3, 8}) {
        Scene scene = base_;
        set_polarised(scene, true);
        if (count > 1) {
            scene.settings.wavelengths_nm.clear();
            for (int i = 0; i < count; ++i)
                scene.settings.wavelengths_nm.push_back(430 + 230.0 * i / (count - 1));
        }
        all_drawings(fmt::format("{} wavelength{}", count, count == 1 ? "" : "s"), scene,
                     count == 1 ? k_full : k_side);
    }
}

void BeamBench::pupils() {
    begin("pupil positions",
          fmt::format("a lens of radius 0.02 diameters, focus a quarter of a diameter before the "
                      "middle; errors against {} samples spread over pixel and pupil, whose own "
                      "noise is in them",
                      k_full));
    for (const int count : {1, 19, 91}) {
        Scene scene = base_;
        if (count > 1) {
            const double size = diameter(scene.stone.solid);
            scene.camera.aperture_radius = 0.02 * size;
            scene.camera.focus_distance =
                glm::length(scene.camera.position - scene.camera.look_at) - 0.25 * size;
            scene.settings.samples = count;
        }
        const std::string what = fmt::format("{} position{}", count, count == 1 ? "" : "s");
        drawing(what + ", preview", scene, Drawing::preview, k_full);
        drawing(what + ", anti-aliased", scene, Drawing::averaged, k_full);
    }
}

void BeamBench::refractions() {
    begin("refraction", fmt::format("how beams follow it; errors against {} samples; "
                                    "astigmatic is what all else uses",
                                    k_full));
    for (const auto& [name, refraction] : {std::pair{"astigmatic", Refraction::astigmatic},
                                           {"perspective", Refraction::perspective},
                                           {"parallel", Refraction::parallel}}) {
        Scene scene = base_;
        scene.settings.refraction = refraction;
        all_drawings(name, scene, k_full);
    }
}

void BeamBench::run(const std::string& only) {
    struct Section {
        const char* name;
        void (BeamBench::*run)();
    };
    const Section sections[] = {{"engines", &BeamBench::engines},
                                {"depth", &BeamBench::depths},
                                {"facets", &BeamBench::stones},
                                {"distance", &BeamBench::distances},
                                {"wavelengths", &BeamBench::wavelengths},
                                {"pupil", &BeamBench::pupils},
                                {"refraction", &BeamBench::refractions},
                                {"relighting", &BeamBench::relighting},
                                {"sequences", &BeamBench::sequences},
                                {"threads", &BeamBench::threads},
                                {"plain", &BeamBench::plain},
                                {"povray", &BeamBench::povray}};
    std::string names;
    bool any = false;
    for (const Section& section : sections) {
        names += std::string(names.empty() ? "" : ", ") + section.name;
        if (!only.empty() && only != section.name) continue;
        (this->*section.run)();
        any = true;
    }
    if (!any) throw InputError("no section " + only + ": one of " + names);
}

}  // namespace culet
