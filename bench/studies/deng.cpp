#include <fmt/format.h>

#include <cmath>

#include "bench/studies/frames.h"
#include "bench/studies/sampling_noise.h"
#include "bench/studies/scenes.h"
#include "bench/studies/source_studies.h"
#include "page/html.h"
#include "render/render.h"
#include "render/scene/scene_io.h"
#include "stone/cuts/cuts.h"

namespace culet {

namespace {

CaptionedPicture drawn_with(Scene scene, const char* engine, const std::string& caption) {
    scene.settings.engine = engine;
    const Picture picture = render(scene).picture;
    return {caption, picture, exposed_for(picture)};
}

void write_shadings(SourcePage& page, Parameters& parameters) {
    page.section("Flat, Gouraud, Phong (1.1, 1.2)");
    page.words(
        "The three interpolations with one illumination model, and what light does (beams). The "
        "first three know nothing of what goes on inside a stone.");
    const Scene scene = face_up(make_cut("round-brilliant"), catalogue_material("sapphire_blue"),
                                "jeweller", parameters.count("shading_pixels"));
    page.pictures({drawn_with(scene, "flat", "flat: one colour a facet"),
                   drawn_with(scene, "gouraud", "Gouraud: colours of corners interpolated"),
                   drawn_with(scene, "phong", "Phong: normals interpolated"),
                   drawn_with(scene, "whitted", "Whitted: rays reflected and refracted"),
                   drawn_with(scene, k_beam_engine, "light: beams")});
    page.learned(
        "Smooth shading is made for smooth things: a cut stone's edges are what it must not "
        "lose. Flat shading is of use as a drawing of the facets, and that is what culet uses "
        "it for.");
}

void write_spheres(SourcePage& page, Parameters& parameters) {
    page.section("Three spheres by random rays (fig. 7)");
    const std::filesystem::path file = parameters.path("spheres_scene");
    const int width = parameters.count("spheres_width"), most = parameters.count("spheres_samples");
    const auto noise = sampling_noise(file, width, {1, 10, 100, most});
    std::vector<CaptionedPicture> shown;
    std::vector<std::vector<std::string>> rows;
    const Scene scene = read_scene(file);
    for (const SamplingNoise& one : noise) {
        rows.push_back({fmt::format("{}", one.samples), significant(one.rms, 3),
                        significant(one.rms * std::sqrt(one.samples), 3),
                        significant(one.seconds, 3)});
        shown.push_back({fmt::format("{} ray{} a pixel", one.samples, one.samples == 1 ? "" : "s"),
                         one.picture, scene.film});
    }
    page.words(
        "Glass, a diffuse ball and rough metal under a sky. Each picture is drawn twice with "
        "other random numbers; the noise is the root mean square of half their difference, "
        "times the root of 2.");
    page.pictures(shown);
    page.table("Noise against rays", {"Rays a pixel", "noise", "noise x root of rays", "CPU s"},
               rows);
    page.learned(
        "The noise falls with the root of the number of rays, or a little faster, because the "
        "rays of a pixel are spread evenly: a thousand take away some 97 % of it. A convex "
        "stone among lights needs no such rays, because its light paths are all followed.");
}

}  // namespace

SourcePage deng_page(Parameters& parameters) {
    SourcePage page("deng", "Deng, reproduced",
                    "Deng, Giving virtual objects color using geometry");
    write_shadings(page, parameters);
    write_spheres(page, parameters);
    return page;
}

}  // namespace culet
