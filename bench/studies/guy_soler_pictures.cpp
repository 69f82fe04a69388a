#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <utility>

#include "bench/studies/frames.h"
#include "bench/studies/guy_soler_sections.h"
#include "bench/studies/scenes.h"
#include "render/render.h"
#include "stone/cuts/cuts.h"
#include "stone/material/material_io.h"
#include "tests/render/bench_scenes.h"

namespace culet {

namespace {

std::string listed_file(const char* name) {
    return fmt::format("{}/bench/studies/guy-soler/{}.toml", CULET_SOURCE_DIR, name);
}

Material listed(const char* name) {
    return read_material(listed_file(name));
}

}  // namespace

void write_linearised_refraction(SourcePage& page, Parameters& parameters) {
    const int pixels = parameters.count("tree_pixels"), depth = parameters.count("tree_depth");
    page.section("Linearised against exact refraction (fig. 6)");
    page.words(
        "A facet tree is exact for parallel light. In perspective each front facet refracts "
        "light towards one virtual eye, to first order. culet's beams also correct every beam "
        "about its own middle ray, with both focal lines of the oblique pencil (astigmatic). "
        "The table counts pixels whose exact ray does not meet the facets that its beam "
        "promises.");
    std::vector<std::vector<std::string>> rows;
    const Material diamond = listed("diamond");
    for (const int facets : {93, 115}) {
        const Solid solid = stone_of_facets(facets);
        for (const double diameters : parameters.numbers("tree_distances")) {
            std::vector<std::string> row{
                fmt::format("{} facets, from {} diameters", facets, diameters)};
            for (const Refraction refraction :
                 {Refraction::parallel, Refraction::perspective, Refraction::astigmatic}) {
                Scene drawn = drawn_as(tree_scene(solid, diamond, diameters, pixels, depth),
                                       Drawing::exact, 0);
                drawn.settings.refraction = refraction;
                const RenderStats stats = FrameRenderer(drawn).draw().stats;
                row.push_back(
                    percent(static_cast<double>(stats.retraced) / static_cast<double>(stats.rays)));
            }
            rows.push_back(std::move(row));
        }
    }
    page.table("Pixels with another sequence of facets than their beam's",
               {"Stone", "parallel", "perspective", "astigmatic (culet)"}, rows);

    Scene scene = tree_scene(stone_of_facets(115), diamond, 2.5, pixels, depth);
    const Picture exact = FrameRenderer(drawn_as(scene, Drawing::averaged, 0)).draw().picture;
    const PngLook look = exposed_for(exact);
    std::vector<CaptionedPicture> shown{{"exact, 2.5 diameters away", exact, look}};
    for (const auto& [name, refraction] : {std::pair{"perspective", Refraction::perspective},
                                           {"astigmatic", Refraction::astigmatic}}) {
        scene.settings.refraction = refraction;
        const Picture flat = FrameRenderer(drawn_as(scene, Drawing::preview, 0)).draw().picture;
        if (refraction == Refraction::perspective)
            shown.push_back({"perspective, one colour a beam", flat, look});
        shown.push_back({fmt::format("{}: difference to exact, twice as bright", name),
                         difference_picture(flat, exact), brightened(look, 2)});
    }
    page.pictures(shown);
    page.learned(
        "The first order about a facet is what facet trees lose most by, and it falls with the "
        "distance. A correction for every beam costs little and leaves next to nothing; the "
        "pixels that remain are followed exactly.");
}

void write_dispersion_trees(SourcePage& page, Parameters& parameters) {
    page.section("One tree against three (fig. 8)");
    page.words(
        "Dispersion sends each colour along facets of its own. The paper shares one tree among "
        "the three colours. culet shares none: with dispersion on there is a tree a wavelength, "
        "with it off one tree and no dispersion at all. So the error below is the most that "
        "sharing can cost.");
    std::vector<std::vector<std::string>> rows;
    std::vector<CaptionedPicture> shown;
    for (const char* name : {"diamond", "tourmaline"}) {
        Material material = listed(name);
        material.optic = OpticCharacter::isotropic;  // the ordinary ray's index alone
        material.absorption_per_mm = {};
        Scene scene = tree_scene(stone_of_facets(115), material, 6, parameters.count("tree_pixels"),
                                 parameters.count("tree_depth"));
        scene.settings.wavelengths_nm = k_three_wavelengths;
        scene = drawn_as(scene, Drawing::averaged, 1);
        const auto three = timed_picture(scene);
        scene.settings.effects[static_cast<std::size_t>(Effects::dispersion)] = false;
        const auto one = timed_picture(scene);
        rows.push_back({name, milliseconds_of(one.time.cpu), milliseconds_of(three.time.cpu),
                        percent(mean_difference(one.result.picture, three.result.picture))});
        const PngLook look = exposed_for(three.result.picture);
        shown.push_back({fmt::format("{}, one tree", name), one.result.picture, look});
        shown.push_back({fmt::format("{}, three trees", name), three.result.picture, look});
    }
    page.table("Time on one thread and difference",
               {"Index of", "one tree, ms", "three trees, ms", "mean difference of luminance"},
               rows);
    page.pictures(shown);
    page.learned(
        "Three trees cost nearly three times as much, and still only milliseconds: there is no "
        "reason left to share one. Where a stone shows no fire, culet's planner finds that out "
        "and draws one.");
}

void write_facet_trees(SourcePage& page, Parameters& parameters) {
    page.section("Facet trees, whole and cut at 4 % (fig. 10)");
    page.words(
        "Branches that carry less than a share of the light are cut. Two stones with as many "
        "facets as the paper's two models (their shapes are others): 115 and 93.");
    std::vector<std::vector<std::string>> rows;
    for (const int facets : {115, 93}) {
        Scene scene =
            tree_scene(stone_of_facets(facets), listed("diamond"), 6,
                       parameters.count("tree_pixels"), parameters.count("cut_tree_depth"));
        scene = drawn_as(scene, Drawing::averaged, 1);
        Picture whole;
        for (const double cut : {0.0, 0.01, 0.04}) {
            scene.settings.tolerance = cut > 0 ? 1e-9 : 0;  // with 0 nothing is cut
            scene.settings.cut_weight = cut;
            const auto tree = timed_picture(scene);
            if (cut == 0) whole = tree.result.picture;
            rows.push_back(
                {fmt::format("{} facets, {}", facets,
                             cut == 0 ? "whole" : fmt::format("cut at {:.0f} %", 100 * cut)),
                 fmt::format("{}", tree.result.stats.beams), milliseconds_of(tree.time.cpu),
                 percent(tree.result.stats.remainder),
                 percent(mean_difference(tree.result.picture, whole))});
        }
    }
    page.table("Beams, time of a picture on one thread, difference to the whole tree",
               {"Tree", "beams", "ms", "light not followed", "mean difference"}, rows);
    page.learned(
        "Cutting at 4 % takes away nearly half of the beams and a hundredth of the light. The "
        "whole tree takes less than a tenth of a second today, so culet cuts only as far as a "
        "tolerance "
        "allows and reports what was cut.");
}

void write_stones(SourcePage& page, Parameters& parameters) {
    const int pixels = parameters.count("stone_pixels");
    const double tolerance = parameters.number("stone_tolerance");
    page.section("Stones (fig. 11, materials of 6.1)");
    page.words(
        "Drawn from the paper's table of materials (bench/studies/guy-soler/*.toml): indices, "
        "dispersion, and absorption for red, green and blue of the ordinary and the "
        "extraordinary ray. samples/dravite-step holds a dravite with the paper's absorption "
        "against a simulated photograph.");
    std::vector<CaptionedPicture> garnets;
    const Solid brilliant = make_cut("round-brilliant", {{"diameter", 8}});
    Scene garnet = face_up(brilliant, listed("garnet"), "daylight", pixels);
    PngLook look;
    for (int inner = 3; inner >= 0; --inner) {
        garnet.settings.engine = k_beam_engine;
        garnet.settings.depth = inner + 2;
        const Picture picture = render(garnet).picture;
        if (garnets.empty()) look = exposed_for(picture);
        garnets.insert(garnets.begin(),
                       {fmt::format("garnet, {} inner reflections", inner), picture, look});
    }
    page.pictures(garnets);
    const auto drawn = [&](const char* cut, const char* name, const Vec3& axis, const char* along) {
        Scene scene = face_up(make_cut(cut, {{"width", 6}}), listed(name), "daylight", pixels);
        const Vec3 across = axis.z != 0 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
        scene.stone.crystal.axes = {axis, across, glm::cross(axis, across)};
        scene.settings.tolerance = tolerance;
        const Picture picture = render(scene).picture;
        return CaptionedPicture{fmt::format("{}, optic axis {}", name, along), picture,
                                exposed_for(picture)};
    };
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    page.pictures({drawn("step", "andalusite", x, "along its length"),
                   drawn("step", "andalusite", y, "across"),
                   drawn("step", "andalusite", z, "towards the eye")});
    page.pictures({drawn("step", "tourmaline", x, "along its length"),
                   drawn("step", "tourmaline", z, "towards the eye"),
                   drawn("oval", "peridot", x, "along its length"),
                   drawn("oval", "sapphire", z, "towards the eye")});
    Scene ring = in_ring(make_cut("oval", {{"width", 6}}), listed_file("peridot"), pixels);
    ring.settings.engine = "whitted";
    const Picture picture = render(ring).picture;
    page.pictures({{"peridot in a ring (engine whitted)", picture, exposed_for(picture)}});
    page.learned(
        "A cut stone lives by its inner reflections: without them a garnet is a dark window. "
        "The axis of a pleochroic stone decides its colour, and a cutter can see it here before "
        "cutting.");
}

}  // namespace culet
