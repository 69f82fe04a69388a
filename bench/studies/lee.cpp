#include <fmt/format.h>

#include "bench/studies/frames.h"
#include "bench/studies/scenes.h"
#include "bench/studies/source_studies.h"
#include "bench/studies/table_cost.h"
#include "page/html.h"
#include "render/render.h"
#include "render/scene/light_presets.h"
#include "stone/cuts/cuts.h"
#include "tests/render/bench_scenes.h"

namespace culet {

namespace {

// Drawn by a ray table, with `change` applied to the scene.
template <class Change>
CaptionedPicture by_table(const std::string& caption, Scene scene, const Change& change) {
    scene.settings.engine = k_raytable_engine;
    scene.settings.samples = 4;
    change(scene);
    const Picture picture = render(scene).picture;
    return {caption, picture, exposed_for(picture)};
}

Scene stone_of(const char* cut, const char* material, Parameters& parameters) {
    Scene scene = face_up(make_cut(cut), catalogue_material(material), "jeweller",
                          parameters.count("picture_pixels"));
    scene.stone.convex = cut_kind(cut).convex;
    scene.settings.depth = parameters.count("depth");
    scene.settings.tolerance = 0;
    scene.settings.effects_auto = false;
    scene.settings.effects.fill(true);
    scene.settings.effects[static_cast<std::size_t>(Effects::dispersion)] = false;
    scene.settings.effects[static_cast<std::size_t>(Effects::birefringence)] = false;
    scene.settings.effects[static_cast<std::size_t>(Effects::coherence)] = false;
    return scene;
}

void write_cuts(SourcePage& page, Parameters& parameters) {
    page.section("Six cuts (fig. 7.1)");
    std::vector<CaptionedPicture> shown;
    for (const char* cut : {"round-brilliant", "oval", "marquise", "pear", "princess", "heart"})
        shown.push_back(by_table(cut, stone_of(cut, "cubic_zirconia", parameters), [](Scene&) {}));
    page.words(
        "Each by a ray table, whose paths are those of the reference. The heart is not convex: "
        "its light may leave and enter again.");
    page.pictures(shown);
    page.learned(
        "A table asks nothing of a stone's shape, because it holds what the paths did, not how "
        "they were found.");
}

void write_variations(SourcePage& page, Parameters& parameters) {
    page.section("Variations (figs. 8.1 to 8.8)");
    page.words(
        "One parameter at a time from the round brilliant of cubic zirconia. Reflection and "
        "transmission factors stand for Fresnel's coefficients, as in the thesis; total "
        "reflection stays total.");
    const Scene base = stone_of("round-brilliant", "cubic_zirconia", parameters);
    const auto index = [&](double n) {
        return by_table(fmt::format("refractive index {}", n), base, [&](Scene& scene) {
            scene.stone.material.index[0] = {};
            scene.stone.material.index[0].n = n;
        });
    };
    page.pictures({index(1.5), index(1.77), index(2.16), index(2.42)});
    const auto depth = [&](int inner) {
        return by_table(fmt::format("inner reflections: {}", inner), base,
                        [&](Scene& scene) { scene.settings.depth = inner + 2; });
    };
    page.pictures({depth(0), depth(1), depth(2), depth(6)});
    const auto factors = [&](double reflection, double transmission) {
        return by_table(fmt::format("reflection {}, transmission {}", reflection, transmission),
                        base, [&](Scene& scene) {
                            scene.settings.reflection_factor = reflection;
                            scene.settings.transmission_factor = transmission;
                        });
    };
    page.pictures({by_table("Fresnel's coefficients", base, [](Scene&) {}), factors(0.15, 0.85),
                   factors(0.5, 0.5), factors(0.85, 0.15)});
    std::vector<CaptionedPicture> lights;
    for (const char* light : {"jeweller", "daylight", "lightbox", "darkfield"})
        lights.push_back(by_table(fmt::format("in the light {}", light), base,
                                  [&](Scene& scene) { scene.lights = *light_preset(light); }));
    page.pictures(lights);
    page.learned(
        "Light and body colour change without tracing. Index and depth change the paths and "
        "need another table. Fresnel's coefficients leave nothing to choose; the factors of the "
        "thesis make another stone.");
}

void write_table_costs(SourcePage& page, Parameters& parameters) {
    page.section("Pre-computation and frame rate (figs. 8.9 to 8.15)");
    page.words(
        "One ray a pixel, one thread, clear diamond in smooth light. Making the table is the "
        "pre-computation; a picture in new light is then read from it. Difference: the largest "
        "to the reference's picture, over the brightest pixel.");
    std::vector<std::vector<std::string>> rows;
    const auto row = [&](const std::string& what, const Scene& scene) {
        const TableCost cost = table_cost(scene);
        rows.push_back({what, fmt::format("{}", cost.exits), significant(cost.bytes / 1e6),
                        milliseconds_of(cost.make_seconds), milliseconds_of(cost.relight_seconds),
                        significant(1 / cost.relight_seconds),
                        significant(cost.reference_seconds / cost.relight_seconds),
                        significant(cost.difference, 1)});
    };
    const int pixels = parameters.count("pixels");
    Scene base = base_scene(pixels);
    base.settings.depth = parameters.count("depth");
    for (const BenchStone& stone : bench_stones()) {
        Scene scene = base;
        scene.stone.solid = stone.solid;
        scene.camera = bench_camera(stone.solid, 6, bench_view(), pixels);
        row(stone.name, scene);
    }
    for (const int size : {pixels / 2, 2 * pixels}) {
        Scene scene = base;
        scene.camera.width = scene.camera.height = size;
        row(fmt::format("73 facets, {0} x {0} pixels", size), scene);
    }
    for (const int inner : {1, 2, 4, 8, 16}) {
        Scene scene = base;
        scene.settings.depth = inner + 2;
        row(fmt::format("73 facets, {} inner reflections", inner), scene);
    }
    page.table(fmt::format("Ray tables of {0} x {0} pixels, unless said otherwise", pixels),
               {"Stone", "exits", "MB", "made, ms", "new light, ms", "pictures a second",
                "times the reference's speed", "difference"},
               rows);
    page.learned(
        "Both stages grow with the pixels and, less than in proportion, with the reflections: "
        "most light leaves early. The number of facets matters little. A table is worth its "
        "making from the second light on; for another view beams are quicker (the page on "
        "Voelker & Hamann).");
}

void write_colours(SourcePage& page, Parameters& parameters) {
    page.section("Coloured stones (fig. 8.16), and Phong (figs. 8.17 to 8.22)");
    std::vector<CaptionedPicture> shown;
    for (const char* material : {"garnet_almandine", "sapphire_blue", "tourmaline_green", "spinel"})
        shown.push_back(
            by_table(material, stone_of("round-brilliant", material, parameters), [](Scene&) {}));
    page.pictures(shown);
    Scene phong = stone_of("round-brilliant", "sapphire_blue", parameters);
    phong.settings.engine = "phong";
    Scene whitted = phong;
    whitted.settings.engine = "whitted";
    std::vector<CaptionedPicture> beside{shown[1]};
    beside.front().caption = "sapphire by a ray table";
    for (const Scene& scene : {phong, whitted}) {
        const Picture picture = render(scene).picture;
        beside.push_back({"sapphire, " + scene.settings.engine, picture, exposed_for(picture)});
    }
    Scene ring = in_ring(make_cut("round-brilliant"), "sapphire_blue", phong.camera.width);
    ring.settings.engine = "whitted";
    const Picture in_gold = render(ring).picture;
    beside.push_back({"sapphire in a ring, whitted", in_gold, exposed_for(in_gold)});
    page.pictures(beside);
    page.words(
        "Ray tables draw a stone alone: what stands around it would have to be in the table.");
    page.learned(
        "Phong's stone is a painted pebble. The colour of a real one lies in how far its light "
        "travelled inside.");
}

}  // namespace

SourcePage lee_page(Parameters& parameters) {
    SourcePage page("lee", "Lee 2004, reproduced",
                    "Lee Hoi Chi Angie, Interactive refractive rendering for gemstones, M.Phil. "
                    "thesis, The Chinese University of Hong Kong, 2004");
    write_cuts(page, parameters);
    write_variations(page, parameters);
    write_table_costs(page, parameters);
    write_colours(page, parameters);
    return page;
}

}  // namespace culet
