#include <fmt/format.h>

#include "bench/plain_tracer.h"
#include "bench/studies/cube_map_light.h"
#include "bench/studies/frames.h"
#include "bench/studies/scenes.h"
#include "bench/studies/source_studies.h"
#include "bench/studies/table_flip.h"
#include "page/html.h"
#include "render/grade/grade.h"
#include "render/render.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "tests/cpu_time.h"
#include "tests/render/bench_scenes.h"

namespace culet {

namespace {

double index_of_diamond() {
    return catalogue_material("diamond").index[0].at(k_grade_nm);
}

CaptionedPicture in_scope(const std::string& caption, const char* light, int pixels) {
    Scene scene =
        face_up(make_cut("round-brilliant"), catalogue_material("diamond"), light, pixels);
    scene.settings.engine = k_beam_engine;
    return {caption, render(scene).picture, {}};
}

CaptionedPicture channel_of(const CaptionedPicture& whole, std::size_t channel,
                            const std::string& caption) {
    CaptionedPicture one = whole;
    one.caption = caption;
    for (std::size_t i = 0; i < one.picture.rgb.size(); ++i)
        if (i % 3 != channel) one.picture.rgb[i] = 0;
    return one;
}

void write_scopes(SourcePage& page, Parameters& parameters) {
    const int pixels = parameters.count("picture_pixels");
    page.section("Scopes");
    page.words(
        "A Tolkowsky brilliant of diamond in the trade's instruments, and ASET by its colours.");
    page.pictures({in_scope("hearts, from below", "hearts", pixels),
                   in_scope("arrows, from above", "arrows", pixels),
                   in_scope("ideal-scope", "idealscope", pixels)});
    const CaptionedPicture aset = in_scope("ASET", "aset", pixels);
    page.pictures({aset, channel_of(aset, 0, "its red: light from 45 to 75 degrees of elevation"),
                   channel_of(aset, 1, "its green: below 45 degrees"),
                   channel_of(aset, 2, "its blue: above 75 degrees, the viewer's head")});
    const EyeLight light =
        EyeLightTracer(make_cut("round-brilliant")).trace({0, 0, 1}, index_of_diamond());
    std::vector<std::vector<std::string>> rows;
    for (const auto& [name, bands] :
         {std::pair{"AGS: 45 and 75 degrees", aset_bands()},
          {"diamond-webgl: 44.4 and 78.5 degrees", diamond_webgl_bands()}}) {
        const AsetShares shares = aset_shares(light, -1, bands);
        rows.push_back({name, percent(shares.red), percent(shares.green), percent(shares.blue),
                        percent(shares.dark)});
    }
    page.table("Shares of the eye's light", {"Boundaries", "red", "green", "blue", "dark"}, rows);
    page.learned(
        "The scopes are lights like any other. A boundary that is off by three degrees moves "
        "light from blue to red; culet's are those of the instrument.");
}

void write_proportions(SourcePage& page, Parameters& parameters) {
    page.section("A brilliant by its proportions");
    page.words(
        "Sliders for proportions show how a pavilion's angle decides what a diamond shows. Here "
        "as a curve: light that comes back to the eye from the sky outside the viewer's head "
        "(ISO, 10 degrees), and what leaks through the pavilion.");
    const Material diamond = catalogue_material("diamond");
    const GradeIndex index = grade_index(&diamond, std::nullopt);
    Chart chart;
    chart.title = "Light return of a round brilliant against its pavilion angle";
    chart.about = "light return and leakage against the pavilion angle";
    chart.x_label = "pavilion angle, degrees";
    chart.y_label = "share of the eye's light, %";
    chart.log_x = chart.log_y = false;
    chart.series = {{"light return (ISO)", {}, true, true, false},
                    {"leakage", {}, true, true, false}};
    GradeOptions options;
    options.coarse = true;
    for (const double angle : parameters.numbers("pavilions_deg")) {
        const Grade grade =
            grade_convex(make_cut("round-brilliant", {{"pavilion-angle", angle}}), index, options);
        ChartPoint point;
        point.x = angle;
        point.y = 100 * grade.face_up.whole[static_cast<std::size_t>(LightModel::iso)];
        chart.series[0].points.push_back(point);
        point.y = 100 * grade.balance.leak;
        chart.series[1].points.push_back(point);
    }
    page.chart(chart);
    page.words(fmt::format(
        "The table's reflection in ASET changes from green to red at a pavilion angle of {:.3f} "
        "degrees. AGS states 40.76; the law of refraction gives (180 - arcsin(sin 45 / n)) / 4 "
        "= {:.3f}.",
        table_flip_deg(index.n), closed_form_table_flip_deg(index.n)));
    page.learned(
        "Within a degree the light return of one and the same cut changes by more than ten "
        "points: what is seen through the table changes as a whole, not little by little.");
}

void write_cost_model(SourcePage& page, Parameters& parameters) {
    page.section("Cost: fragments x bounces x facets");
    page.words(
        "A shader that tests every plane at every bounce takes time in proportion to pixels, "
        "bounces and facets. Measured with culet's plain ray tracer on one thread; beside it "
        "the same tracer that walks from facet to facet.");
    std::vector<std::vector<std::string>> rows;
    const int pixels = parameters.count("cost_pixels");
    for (const BenchStone& stone : bench_stones()) {
        for (const int depth : {4, 8, 16}) {
            Scene scene = tree_scene(stone.solid, catalogue_material("diamond"), 6, pixels, depth);
            const PlainTracer tracer(scene);
            Picture picture;
            PlainTracing every, walk;
            every.search = ExitSearch::every_plane;
            const double planes = quickest([&] { tracer.draw(every, picture); }, 3, 0.1).cpu,
                         walked = quickest([&] { tracer.draw(walk, picture); }, 3, 0.1).cpu;
            const double bounces = static_cast<double>(pixels) * pixels * (depth - 1);
            rows.push_back({fmt::format("{}, {} bounces", stone.name, depth - 1),
                            milliseconds_of(planes), significant(1e9 * planes / bounces),
                            significant(1e12 * planes / bounces /
                                        static_cast<double>(stone.solid.facets.size())),
                            milliseconds_of(walked), significant(1e9 * walked / bounces)});
        }
    }
    page.table("Every plane, and a walk over neighbouring facets",
               {"Stone", "every plane, ms", "ns a pixel and bounce", "ps a pixel, bounce and facet",
                "walk, ms", "ns a pixel and bounce"},
               rows);
    page.learned(
        "The model holds within a fifth from 57 to 304 facets. A walk over neighbours is two to "
        "three times as quick over the first bounces. After many the rays of a packet have "
        "parted, and it is not.");
}

void write_cube_map(SourcePage& page, Parameters& parameters) {
    page.section("Light by direction alone (cube map)");
    page.words(
        "A cube map gives light by direction, wherever on the stone a ray leaves. That is right "
        "for a sky and wrong for a window near by. Two windows, as large and at such a distance "
        "that they look the same from the stone's middle; the map holds exactly that view.");
    std::vector<std::vector<std::string>> rows;
    Scene scene = tree_scene(make_cut("round-brilliant"), catalogue_material("diamond"), 6,
                             parameters.count("cube_pixels"), 8);
    const double size = diameter(scene.stone.solid);
    for (const double distance : parameters.numbers("cube_distances"))
        rows.push_back({fmt::format("{} diameters", distance),
                        percent(cube_map_error(scene, windows_at(distance * size),
                                               parameters.count("cube_width")))});
    page.table("Mean error of a picture with a map instead of the windows",
               {"Distance of the windows", "off by"}, rows);
    page.learned(
        "The error falls with the distance, down to what the map's texels leave. For a stone on "
        "a table or in a ring the short cut is wrong by much; culet looks up near lights where "
        "they are.");
}

}  // namespace

SourcePage diamond_webgl_page(Parameters& parameters) {
    SourcePage page(
        "diamond-webgl", "diamond-webgl, reproduced",
        "piellardj, diamond-webgl: real-time diamonds in a browser by half-space tracing");
    write_scopes(page, parameters);
    write_proportions(page, parameters);
    write_cost_model(page, parameters);
    write_cube_map(page, parameters);
    return page;
}

}  // namespace culet
