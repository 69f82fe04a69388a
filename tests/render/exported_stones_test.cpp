// What the exporters for other renderers write for each stone. Expectations: a published dispersion
// formula, and the stones' own materials.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "render/export/mitsuba.h"
#include "render/export/pbrt.h"
#include "render/export/povray.h"
#include "stone/export/mean_material.h"
#include "tests/render/ray_stones.h"

namespace culet {
namespace {

Scene one_stone() {
    Scene scene;
    std::mt19937_64 random(11);
    scene.stone.solid = random_stone(random, 8);
    scene.camera.position = {40, 20, 70};
    scene.lights.constant = 0.2;
    return scene;
}

std::vector<std::pair<double, double>> spectrum_in(const std::string& text,
                                                   const std::string& name) {
    const std::string words = "\"spectrum " + name + "\" [";
    const std::size_t at = text.find(words);
    EXPECT_NE(at, std::string::npos) << words;
    std::vector<std::pair<double, double>> pairs;
    if (at == std::string::npos) return pairs;
    std::istringstream in(text.substr(at + words.size()));
    for (double nm = 0, value = 0; in >> nm >> value;) pairs.emplace_back(nm, value);
    return pairs;
}

// Peter 1923, wavelengths in micrometres; measured up to 760 nm.
TEST(ExportedStones, DiamondDispersesAsPublished) {
    Scene scene = one_stone();
    scene.stone.material = catalogue_material("diamond");
    int seen = 0;
    for (const auto& [nm, eta] : spectrum_in(pbrt_scene(scene, "s").text, "eta")) {
        if (nm < 380 || nm > 760) continue;
        ++seen;
        const double square = nm * nm * 1e-6;
        EXPECT_NEAR(eta,
                    std::sqrt(1 + 0.3306 * square / (square - 0.175 * 0.175) +
                              4.3356 * square / (square - 0.106 * 0.106)),
                    1e-12);
    }
    EXPECT_EQ(seen, 39);
}

// The first stone is clear, isotropic glass of one index; the others must still disperse, absorb
// and split light.
TEST(ExportedStones, EachHasTheOpticsOfItsOwnMaterial) {
    Scene scene = one_stone();
    scene.stone.material.index[0].n = 1.5;
    double far = 0;
    for (const char* name : {"garnet_almandine", "quartz"}) {
        Stone& more = scene.more_stones.emplace_back(scene.stone);
        more.material = catalogue_material(name);
        far += 10;
        for (Vec3& vertex : more.solid.vertices) vertex.x += far;
        for (Facet& facet : more.solid.facets) facet.plane.offset += far * facet.plane.normal.x;
    }
    const Material& garnet = scene.more_stones[0].material;
    const ExportedScene pbrt = pbrt_scene(scene, "s"), mitsuba = mitsuba_scene(scene, "s"),
                        povray = povray_scene(scene);

    EXPECT_NE(pbrt.text.find("\"float eta\" [ 1.5 ]"), std::string::npos);
    const auto eta = spectrum_in(pbrt.text, "eta"), sigma = spectrum_in(pbrt.text, "sigma_a");
    ASSERT_FALSE(eta.empty());
    ASSERT_EQ(eta.size(), sigma.size());
    for (std::size_t i = 0; i < eta.size(); ++i) {
        const double nm = eta[i].first;
        if (nm < 380 || nm > 780) continue;
        EXPECT_NEAR(eta[i].second, mean_index(garnet, nm), 1e-12);
        EXPECT_NEAR(sigma[i].second, mm_per(scene.stone.unit) * mean_absorption(garnet, nm), 1e-12);
    }
    EXPECT_NE(mitsuba.text.find("sigma_t"), std::string::npos);
    EXPECT_NE(povray.text.find("media { absorption"), std::string::npos);
    for (const ExportedScene& written : {pbrt, mitsuba, povray}) {
        std::string all;
        for (const std::string& note : written.notes) all += note + "\n";
        EXPECT_NE(all.find("double refraction"), std::string::npos) << all;
    }
    for (const ExportedScene& written : {mitsuba, povray}) {
        std::string all;
        for (const std::string& note : written.notes) all += note + "\n";
        EXPECT_NE(all.find("dispersion: "), std::string::npos) << all;
    }
}

// The two maps have different shapes: in one folder they must not share a name.
TEST(ExportedStones, FilesBesideTheScenesHaveNamesOfTheirOwn) {
    Scene scene = one_stone();
    scene.lights.sources.push_back(HemisphereLight{{0, 0, 1}, {1.0}});
    const ExportedScene pbrt = pbrt_scene(scene, "s"), mitsuba = mitsuba_scene(scene, "s");
    ASSERT_TRUE(pbrt.environment && mitsuba.environment);
    EXPECT_NE(pbrt.environment->first, mitsuba.environment->first);
}

}  // namespace
}  // namespace culet
