// The renderer by beams: pictures a second and error, one parameter at a time about a base case
// (bench_scenes.h), beside the reference, a plain ray tracer and POV-Ray. docs/rendering.md says
// how to read it.
//
//   bench_beams [--pixels N] [--section NAME] [--json FILE] [--cache DIR]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <iostream>

#include "render/beams/beam_shading.h"
#include "render/render.h"
#include "stone/errors.h"
#include "stone/output_file.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/bench_table.h"
#include "tests/bench/cpu_time.h"
#include "tests/bench/plain_tracer.h"
#include "tests/bench/povray_run.h"
#include "tests/bench/reference_pictures.h"

namespace {

using namespace culet;

constexpr int k_full = 256, k_side = 64;  // samples of the reference

enum class Drawing { preview, exact, averaged };

Scene drawn_as(Scene scene, Drawing drawing, int threads) {
    scene.settings.engine = drawing == Drawing::preview ? "preview" : "beams";
    if (drawing == Drawing::exact) scene.settings.samples = 1;
    scene.settings.threads = threads;
    return scene;
}

// Frames whose camera moves by too little to see, so that all is drawn anew.
Clocks frame_time(FrameRenderer& frames, const Camera& camera) {
    frames.draw();
    Camera moved = camera;
    double to = 1e-9;
    return quickest(
        [&] {
            moved.position.x = camera.position.x * (1 + to);
            to = -to;
            frames.look_from(moved);
            frames.draw();
        },
        5, 0.25);
}

std::string milliseconds(double seconds) {
    return fmt::format("{:.2f}", 1e3 * seconds);
}

class Bench {
public:
    Bench(int pixels, const std::filesystem::path& cache)
        : pixels_(pixels), references_(cache), base_(base_scene(pixels)) {}

    void run(const std::string& only);
    BenchTables& tables() { return tables_; }

private:
    void begin(const std::string& name, const std::string& remark) {
        tables_.section(name, remark, k_columns);
    }
    Clocks drawings(const std::string& what, const Scene& scene, Drawing drawing, int samples);
    void all_drawings(const std::string& what, const Scene& scene, int samples) {
        drawings(what + ", preview", scene, Drawing::preview, samples);
        drawings(what + ", exact", scene, Drawing::exact, samples);
        drawings(what + ", anti-aliased", scene, Drawing::averaged, samples);
    }
    void reference(int samples);

    void engines();
    void depths();
    void stones();
    void distances();
    void wavelengths();
    void pupils();
    void refractions();
    void relighting();
    void sequences();
    void threads();
    void plain();
    void povray();

    static const std::vector<std::string> k_columns;
    int pixels_;
    ReferencePictures references_;
    BenchTables tables_;
    Scene base_;
};

const std::vector<std::string> Bench::k_columns{"CPU ms",   "wall ms",   "pictures/s", "beams",
                                                "retraced", "lost area", "RMSE",       "PSNR",
                                                "error",    "reported",  "off"};

// A line of the table; CPU time on one thread, wall time on all.
Clocks Bench::drawings(const std::string& what, const Scene& scene, Drawing drawing, int samples) {
    FrameRenderer one(drawn_as(scene, drawing, 1)), all(drawn_as(scene, drawing, 0));
    const Clocks took{frame_time(one, scene.camera).cpu, frame_time(all, scene.camera).wall};
    one.look_from(scene.camera);
    const RenderResult& result = one.draw(true);
    const RenderStats& stats = result.stats;
    const Difference d = difference(result.picture, references_.at(scene, samples));
    // One ray a pixel is promised to be the reference's ray.
    const bool single = drawing == Drawing::exact && scene.camera.aperture_radius == 0;
    const Difference promised = single ? difference(result.picture, references_.at(scene, 1)) : d;
    tables_.line(what, {milliseconds(took.cpu), milliseconds(took.wall),
                        fmt::format("{:.1f}", 1 / took.wall), fmt::format("{}", stats.beams),
                        fmt::format("{}", stats.retraced), fmt::format("{:.1e}", stats.lost_area),
                        fmt::format("{:.2e}", d.rmse), fmt::format("{:.1f}", d.psnr()),
                        fmt::format("{:.2e}", promised.of_stone / stats.mean_radiance),
                        fmt::format("{:.2e}", stats.engine_error),
                        single ? fmt::format("{}", promised.off) : std::string()});
    return took;
}

void Bench::reference(int samples) {
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

void Bench::engines() {
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

void Bench::depths() {
    begin("depth", fmt::format("errors against {} samples (8: {})", k_side, k_full));
    for (int depth = 2; depth <= 12; depth += 2) {
        Scene scene = base_;
        scene.settings.depth = depth;
        all_drawings(fmt::format("depth {}", depth), scene, depth == 8 ? k_full : k_side);
    }
}

void Bench::stones() {
    begin("facets", fmt::format("errors against {} samples (73: {})", k_side, k_full));
    for (const BenchStone& stone : bench_stones()) {
        Scene scene = base_;
        scene.stone.solid = stone.solid;
        scene.camera = bench_camera(stone.solid, 6, bench_view(), pixels_);
        all_drawings(stone.name, scene, stone.solid.facets.size() == 73 ? k_full : k_side);
    }
}

void Bench::distances() {
    begin("distance", fmt::format("errors against {} samples (6: {})", k_side, k_full));
    for (const double diameters : {2.5, 6.0, 20.0}) {
        Scene scene = base_;
        scene.camera = bench_camera(scene.stone.solid, diameters, bench_view(), pixels_);
        all_drawings(fmt::format("{} diameters", diameters), scene,
                     diameters == 6 ? k_full : k_side);
    }
}

void Bench::wavelengths() {
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

void Bench::pupils() {
    begin("pupil positions",
          fmt::format("a lens of 0.02 diameters, focus at the table; errors against {} samples "
                      "spread over pixel and pupil, whose own noise is in them (1, a pinhole: {})",
                      k_side, k_full));
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
        drawings(what + ", preview", scene, Drawing::preview, count == 1 ? k_full : k_side);
        drawings(what + ", anti-aliased", scene, Drawing::averaged, count == 1 ? k_full : k_side);
    }
}

void Bench::refractions() {
    begin("refraction", fmt::format("how beams follow it; preview; errors against {} samples; "
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

void Bench::relighting() {
    tables_.section("relighting",
                    "other lights, same view: the beams are kept; whole: light_with and draw; "
                    "one thread",
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

void Bench::sequences() {
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

void Bench::threads() {
    tables_.section("threads", "base case; speed-up: wall time of one thread over that of two",
                    {"CPU 1", "wall 1", "CPU 2", "wall 2", "speed-up"});
    for (const auto& [name, drawing] : {std::pair{"preview", Drawing::preview},
                                        {"exact", Drawing::exact},
                                        {"anti-aliased", Drawing::averaged}}) {
        FrameRenderer one(drawn_as(base_, drawing, 1)), two(drawn_as(base_, drawing, 2));
        const Clocks a = frame_time(one, base_.camera), b = frame_time(two, base_.camera);
        tables_.line(name, {milliseconds(a.cpu), milliseconds(a.wall), milliseconds(b.cpu),
                            milliseconds(b.wall), fmt::format("{:.2f}", a.wall / b.wall)});
    }
}

void Bench::plain() {
    tables_.section(
        "plain tracer",
        fmt::format("packets of rays without beams, one thread; errors against {} samples", k_full),
        {"CPU ms", "RMSE", "PSNR", "off"});
    for (const bool polarised : {false, true}) {
        Scene scene = base_;
        set_polarised(scene, polarised);
        const std::string of = polarised ? "polarised, " : "unpolarised, ";
        const PlainTracer tracer(scene);
        Picture picture;
        struct Point {
            double rmse, seconds, samples;
        };
        std::vector<Point> points;
        const Picture& reference = references_.at(scene, k_full);
        for (const int across : {1, 2, 3, 4, 5, 6, 8}) {
            PlainTracing how;
            how.across = across;
            how.polarised = polarised;
            double seconds = 1e300;
            std::string search;
            // The slower search is shown once.
            for (const ExitSearch kind : {ExitSearch::walk, ExitSearch::every_plane}) {
                if (kind == ExitSearch::every_plane && across > 1) continue;
                how.search = kind;
                const double took =
                    quickest([&] { tracer.draw(how, picture); }, across < 4 ? 4 : 2, 0).cpu;
                seconds = std::min(seconds, took);
                search = kind == ExitSearch::walk ? "" : ", every plane";
                const Difference d = difference(picture, reference);
                const std::string off =
                    across > 1
                        ? ""
                        : fmt::format("{}", difference(picture, references_.at(scene, 1)).off);
                tables_.line(fmt::format("{}{} sample{}{}", of, across * across,
                                         across == 1 ? "" : "s", search),
                             {milliseconds(took), fmt::format("{:.2e}", d.rmse),
                              fmt::format("{:.1f}", d.psnr()), off});
                if (kind == ExitSearch::walk)
                    points.push_back({d.rmse, took, static_cast<double>(across * across)});
            }
        }
        for (const auto& [name, drawing] :
             {std::pair{"preview", Drawing::preview}, {"anti-aliased beams", Drawing::averaged}}) {
            FrameRenderer frames(drawn_as(scene, drawing, 1));
            const double beams = frame_time(frames, scene.camera).cpu;
            const Difference d = difference(frames.draw().picture, reference);
            // Straight lines between logarithms; beyond the ends the nearest line goes on.
            std::size_t i = 0;
            while (i + 2 < points.size() && points[i + 1].rmse > d.rmse) ++i;
            const Point &a = points[i], &b = points[i + 1];
            const double t = std::log(d.rmse / a.rmse) / std::log(b.rmse / a.rmse);
            const auto between = [&](double from, double to) {
                return from * std::pow(to / from, t);
            };
            const double seconds = between(a.seconds, b.seconds);
            tables_.line(of + name, {milliseconds(beams), fmt::format("{:.2e}", d.rmse),
                                     fmt::format("{:.1f}", d.psnr()), ""});
            tables_.remark(fmt::format(
                "  {}{}: the plain tracer comes to that error with {:.1f} samples, {} ms: {:.1f} "
                "times the time{}",
                of, name, between(a.samples, b.samples), milliseconds(seconds), seconds / beams,
                t < 0 || t > 1 ? " (extrapolated)" : ""));
        }
    }
}

void Bench::povray() {
    constexpr int k_level = 8;
    tables_.section(
        "POV-Ray",
        fmt::format("max_trace_level {}, +A0.1 +AM2 +R3, one thread, seconds of tracing; "
                    "lights of 0.9 at most, because a PNG holds no more than 1; "
                    "errors against {} samples of the reference, unpolarised",
                    k_level, k_full),
        {"CPU s", "RMSE", "PSNR", "POV-Ray/it", "bound"});
    if (!povray_is_installed()) {
        tables_.remark("povray is not installed");
        return;
    }
    Scene scene = base_;
    scene.lights = smooth_lights(0.9);
    scene.settings.depth = k_level - 1;
    const Picture reference = references_.at(scene, k_full);
    const PovrayRun theirs = PovrayFolder().draw(scene, "+A0.1 +AM2 +R3", 1);
    const auto line = [&](const std::string& what, double seconds, const Picture& picture,
                          const std::string& bound) {
        const Difference d = difference(picture, reference);
        tables_.line(what, {fmt::format("{:.4f}", seconds), fmt::format("{:.2e}", d.rmse),
                            fmt::format("{:.1f}", d.psnr()),
                            fmt::format("{:.0f}", theirs.seconds / seconds), bound});
    };
    line("POV-Ray", theirs.seconds, theirs.picture, "");
    for (const bool polarised : {false, true}) {
        set_polarised(scene, polarised);
        for (const auto& [name, drawing] :
             {std::pair{"preview", Drawing::preview}, {"anti-aliased", Drawing::averaged}}) {
            FrameRenderer frames(drawn_as(scene, drawing, 1));
            const double seconds = frame_time(frames, scene.camera).cpu;
            const RenderResult& result = frames.draw(true);
            line(fmt::format("{}, {}", polarised ? "polarised" : "unpolarised", name), seconds,
                 result.picture, fmt::format("{:.3f}", result.stats.error_bound));
        }
    }
}

struct Section {
    const char* name;
    void (Bench::*run)();
};

void Bench::run(const std::string& only) {
    const Section sections[] = {{"engines", &Bench::engines},
                                {"depth", &Bench::depths},
                                {"facets", &Bench::stones},
                                {"distance", &Bench::distances},
                                {"wavelengths", &Bench::wavelengths},
                                {"pupil", &Bench::pupils},
                                {"refraction", &Bench::refractions},
                                {"relighting", &Bench::relighting},
                                {"sequences", &Bench::sequences},
                                {"threads", &Bench::threads},
                                {"plain", &Bench::plain},
                                {"povray", &Bench::povray}};
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

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Speed and error of the renderer by beams, in tables on stdout."};
    int pixels = 800;
    std::string section, json, cache;
    app.add_option("--pixels", pixels, "width and height of the pictures")
        ->check(CLI::Range(16, 4000));
    app.add_option("--section", section, "run this part only");
    app.add_option("--json", json, "also write the tables here");
    app.add_option("--cache", cache,
                   "folder that keeps the reference's pictures from run to run; empty it when the "
                   "reference changes")
        ->check(CLI::ExistingDirectory);
    try {
        app.parse(argc, argv);
        const std::string processor = shading_targets().front();
        std::cout << fmt::format(
            "bench_beams, {} x {} pixels, {}\nCPU ms: quickest, one thread; wall ms: all threads; "
            "PSNR: over the largest radiance of the reference's picture;\nerror: mean difference "
            "over "
            "the stone's pixels, over their mean radiance; reported: what the renderer says that "
            "it "
            "is at most\n(both of the exact drawing: to the reference with 1 sample); off: pixels "
            "of the exact drawing over 1e-3 of the peak away from that\n",
            pixels, pixels, processor);
        Bench bench(pixels, cache);
        bench.run(section);
        if (!json.empty())
            write_text(json, bench.tables().json({{"schema", "1"},
                                                  {"pixels", std::to_string(pixels)},
                                                  {"instructions", processor}}));
        return 0;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "bench_beams: " << error.what() << "\n";
    } catch (const std::exception& error) {
        std::cerr << "bench_beams: " << error.what() << "\n";
    }
    return 2;
}
