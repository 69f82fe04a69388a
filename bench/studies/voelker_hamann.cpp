#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "bench/plain_tracer.h"
#include "bench/povray_run.h"
#include "bench/studies/frames.h"
#include "bench/studies/scenes.h"
#include "bench/studies/source_studies.h"
#include "page/html.h"
#include "render/optimize/optimize.h"
#include "render/render.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "tests/render/bench_scenes.h"

namespace culet {

namespace {

Scene brilliant_scene(Parameters& parameters) {
    Scene scene = base_scene(parameters.count("pixels"));
    scene.settings.depth = parameters.count("depth");
    return scene;
}

void look_through_lens(Scene& scene, double radius, int positions) {
    const double size = diameter(scene.stone.solid);
    scene.camera.aperture_radius = radius * size;
    scene.camera.focus_distance =
        glm::length(scene.camera.position - scene.camera.look_at) - 0.25 * size;
    scene.settings.samples = positions;
}

void write_times(SourcePage& page, Parameters& parameters) {
    page.section("Times (fig. 7)");
    page.words(
        "A round brilliant of diamond, 73 facets, tilted by 20 degrees. Preview: one colour a "
        "beam, as the paper has it. Exact: every pixel by its own ray along its beam's facets, "
        "over the pixel's area. Processor time of one thread; the paper's times are as it "
        "reports them, on the machine of its day and with a stone of its own.");
    struct Kind {
        const char* what;
        Refraction refraction;
        bool three_wavelengths, lens;
        const char* reported;
    };
    std::vector<std::vector<std::string>> rows;
    for (const Kind& kind :
         {Kind{"parallel refraction", Refraction::parallel, false, false, "65.5"},
          {"perspective refraction", Refraction::perspective, false, false, "80.9"},
          {"perspective, three wavelengths", Refraction::perspective, true, false, "236"},
          {"perspective, three wavelengths, lens", Refraction::perspective, true, true, "65200"},
          {"astigmatic (culet)", Refraction::astigmatic, false, false, ""},
          {"astigmatic, three wavelengths", Refraction::astigmatic, true, false, ""},
          {"astigmatic, three wavelengths, lens", Refraction::astigmatic, true, true, ""}}) {
        Scene scene = brilliant_scene(parameters);
        scene.settings.refraction = kind.refraction;
        if (kind.three_wavelengths) scene.settings.wavelengths_nm = k_three_wavelengths;
        if (kind.lens)
            look_through_lens(scene, parameters.number("lens_radius"),
                              parameters.count("lens_positions"));
        Scene truth = drawn_as(scene, Drawing::averaged, 0);
        truth.settings.refraction = Refraction::astigmatic;
        const Picture exact = FrameRenderer(truth).draw().picture;
        const TimedPicture preview = timed_picture(drawn_as(scene, Drawing::preview, 1));
        const TimedPicture averaged = timed_picture(drawn_as(scene, Drawing::averaged, 1));
        rows.push_back({kind.what, kind.reported, milliseconds_of(preview.time.cpu),
                        percent(mean_difference(preview.result.picture, exact)),
                        milliseconds_of(averaged.time.cpu),
                        percent(mean_difference(averaged.result.picture, exact))});
    }
    page.table("Milliseconds a picture, and mean difference to the exact picture",
               {"Drawing", "reported, ms", "preview, ms", "off by", "exact, ms", "off by"}, rows);
    page.learned(
        "Parallel and perspective refraction put reflexes in the wrong place. Following "
        "refraction about every beam takes hardly longer and puts them right. Exact shading "
        "takes two to three times as long as the preview, and then nothing is approximated.");
}

void write_depths(SourcePage& page, Parameters& parameters) {
    page.section("Time against depth (fig. 8)");
    page.words("Depth d: the front facet and d - 1 inner segments. Nothing is cut.");
    Chart chart;
    chart.title = "Time of a picture against depth";
    chart.about = "milliseconds of a picture against the depth to which beams are followed";
    chart.x_label = "depth";
    chart.y_label = "processor time, ms";
    chart.log_x = false;
    std::vector<std::vector<std::string>> beams;
    for (const auto& [name, drawing, refraction] :
         {std::tuple{"preview, parallel", Drawing::preview, Refraction::parallel},
          {"preview, perspective", Drawing::preview, Refraction::perspective},
          {"exact, astigmatic", Drawing::averaged, Refraction::astigmatic}}) {
        ChartSeries series{name, {}, true, true, false};
        for (int depth = 1; depth <= parameters.count("deepest"); ++depth) {
            Scene scene = brilliant_scene(parameters);
            scene.settings.depth = depth;
            scene.settings.refraction = refraction;
            const TimedPicture timed = timed_picture(drawn_as(scene, drawing, 1));
            ChartPoint point;
            point.x = depth;
            point.y = 1e3 * timed.time.cpu;
            series.points.push_back(point);
            if (drawing != Drawing::averaged) continue;
            beams.push_back({fmt::format("{}", depth), fmt::format("{}", timed.result.stats.beams),
                             percent(timed.result.stats.remainder)});
        }
        chart.series.push_back(std::move(series));
    }
    page.chart(chart);
    page.table("Beams, and the light that is not followed further", {"Depth", "beams", "left"},
               beams);
    page.learned(
        "The number of beams grows more slowly than exponentially, though each could split at "
        "every facet: a small beam meets one facet whole.");
}

void write_rivals(SourcePage& page, Parameters& parameters) {
    page.section("Beams against ray tracing (fig. 9)");
    Scene scene = brilliant_scene(parameters);
    scene.lights = smooth_lights(0.9);  // POV-Ray writes a PNG, whose values end at 1
    Scene truth = scene;
    truth.settings.engine = k_reference_engine;
    truth.settings.check = Check::none;
    truth.settings.samples = parameters.count("truth_samples");
    const Picture exact = render(truth).picture;
    std::vector<std::vector<std::string>> rows;
    double povray = 0;
    const auto row = [&](const std::string& what, double seconds, const Picture& picture) {
        rows.push_back({what, milliseconds_of(seconds),
                        povray > 0 ? significant(povray / seconds, 2) : "–",
                        percent(mean_difference(picture, exact))});
    };
    if (povray_is_installed()) {
        Scene theirs = scene;
        theirs.settings.depth = scene.settings.depth - 1;  // a trace level is an inner segment
        const PovrayRun run = PovrayFolder().draw(theirs, "+A0.1 +AM2 +R3", 1);
        povray = run.seconds;
        row("POV-Ray, anti-aliased", run.seconds, run.picture);
    }
    const PlainTracer tracer(scene);
    for (const int across : {1, 4}) {
        PlainTracing how;
        how.across = across;
        Picture picture;
        const double seconds = quickest([&] { tracer.draw(how, picture); }, 3, 0.2).cpu;
        row(fmt::format("plain ray tracer, {} ray{} a pixel", across * across,
                        across == 1 ? "" : "s"),
            seconds, picture);
    }
    const PngLook look = exposed_for(exact);
    std::vector<CaptionedPicture> shown{{"reference", exact, look}};
    for (const auto& [name, drawing, refraction] :
         {std::tuple{"beams, preview, parallel", Drawing::preview, Refraction::parallel},
          {"beams, preview, perspective", Drawing::preview, Refraction::perspective},
          {"beams, exact", Drawing::averaged, Refraction::astigmatic}}) {
        scene.settings.refraction = refraction;
        const TimedPicture timed = timed_picture(drawn_as(scene, drawing, 1));
        row(name, timed.time.cpu, timed.result.picture);
        shown.push_back({fmt::format("{}: difference, twice as bright", name),
                         difference_picture(timed.result.picture, exact), brightened(look, 2)});
    }
    page.words(
        "One thread each. POV-Ray takes part where it is installed; the paper reports 1100 to "
        "9300 times its speed. The plain ray tracer is culet's own: packets of rays that use "
        "the processor's vectors, no beams.");
    page.table("Milliseconds, speed over POV-Ray's, mean difference to the reference",
               {"Drawing", "ms", "times POV-Ray's speed", "off by"}, rows);
    page.pictures(shown);
    page.learned(
        "POV-Ray is two to three orders of magnitude slower, as the paper found; the factor "
        "depends on depth and on how POV-Ray smooths edges. The ray tracer that is written with "
        "as much care as the beams is the harder rival: one ray a pixel is as quick, and "
        "sixteen take several times as long as exact beams and still show more error.");
}

void write_microscope(SourcePage& page, Parameters& parameters) {
    page.section("Cubic zirconia under a microscope (fig. 10)");
    page.words(
        "A light box, red, green and blue of 620, 540 and 445 nm, and a lens near the stone, "
        "focused on its table.");
    const Solid solid = make_cut("round-brilliant");
    std::vector<CaptionedPicture> shown;
    std::vector<std::vector<std::string>> rows;
    PngLook look;
    for (const int positions : {1, parameters.count("microscope_positions")}) {
        Scene scene = face_up(solid, catalogue_material("cubic_zirconia"), "lightbox",
                              parameters.count("microscope_pixels"));
        scene.camera = bench_camera(solid, 2.5, bench_view(), scene.camera.width);
        scene.settings.wavelengths_nm = k_three_wavelengths;
        scene.settings.depth = parameters.count("depth");
        scene.settings.tolerance = 0.01;
        if (positions > 1)
            look_through_lens(scene, parameters.number("microscope_radius"), positions);
        const TimedPicture timed = timed_picture(drawn_as(scene, Drawing::averaged, 1));
        if (shown.empty()) look = exposed_for(timed.result.picture);
        const std::string what =
            positions == 1 ? "a pinhole" : fmt::format("{} lens positions", positions);
        shown.push_back({what, timed.result.picture, look});
        rows.push_back({what, significant(timed.time.cpu, 3)});
    }
    page.pictures(shown);
    page.table("Processor time", {"Lens", "seconds"}, rows);
    page.learned(
        "A lens position costs nearly as much as a picture. The lens takes away what a pinhole "
        "makes of a stone: below the table little is sharp, and colours overlap.");
}

// The optimised angle of the tier of that name.
double tier_deg(const Optimized& found, const char* name) {
    for (const OptimizedTier& tier : found.tiers)
        if (tier.tier.name == name) return degrees(tier.to);
    return std::nan("");
}

void write_objectives(SourcePage& page, Parameters& parameters) {
    page.section("Brilliance and fire as objectives (section 5)");
    const double crown = parameters.number("poor_crown_deg"),
                 pavilion = parameters.number("poor_pavilion_deg");
    page.words(fmt::format(
        "The paper proposes to search for better cuts by brilliance and fire. culet optimize does: "
        "all tiers' angles change by up to 8 degrees, meets are kept. From a brilliant of diamond "
        "with a crown of {} and a pavilion of {} degrees.",
        crown, pavilion));
    const Solid start =
        make_cut("round-brilliant", {{"pavilion-angle", pavilion}, {"crown-angle", crown}});
    const Material diamond = catalogue_material("diamond");
    std::vector<std::vector<std::string>> rows;
    for (const char* objective : {"brilliance", "fire", "brilliance=1,fire=1"}) {
        OptimizeOptions options;
        options.merit.index = grade_index(&diamond, std::nullopt);
        options.merit.weights = merit_weights(objective);
        options.evaluations = parameters.count("evaluations");
        const Clocks before = clocks();
        const Optimized found = optimize_cut(start, options);
        rows.push_back({objective, fmt::format("{:.1f}", found.at_start.total),
                        fmt::format("{:.1f}", found.by_two_factors.total),
                        fmt::format("{:.1f}", found.at_better.total),
                        fmt::format("{:.1f}, {:.1f}", tier_deg(found, "C"), tier_deg(found, "P")),
                        fmt::format("{:.0f}", 100 * table_share(found.better)),
                        fmt::format("{}", found.evaluations),
                        fmt::format("{:.0f}", 1e3 * (clocks().cpu - before.cpu) /
                                                  std::max(1, found.evaluations))});
    }
    page.table("Merit before and after, per cent",
               {"Objective", "before", "crown and pavilion scaled", "all tiers",
                "crown and pavilion angle, degrees", "table, %", "evaluations", "ms an evaluation"},
               rows);
    page.learned(
        "Both are smooth enough to search by, because beams integrate exactly. Here they agree on "
        "crown and pavilion and differ in the table: brilliance wants a large one, fire a small "
        "one. "
        "The search is local: from a pavilion of 38 degrees brilliance ends lower, at 38 degrees.");
}

}  // namespace

SourcePage voelker_hamann_page(Parameters& parameters) {
    SourcePage page("voelker-hamann", "Voelker & Hamann, reproduced",
                    "Voelker and Hamann, Real-Time Rendering of Cut Diamonds");
    write_times(page, parameters);
    write_depths(page, parameters);
    write_rivals(page, parameters);
    write_microscope(page, parameters);
    write_objectives(page, parameters);
    return page;
}

}  // namespace culet
