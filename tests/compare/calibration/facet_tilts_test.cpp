#include "compare/calibration/facet_tilts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/calibration/calibrate.h"
#include "compare/calibration/cropped_camera.h"
#include "compare/calibration/facet_error.h"
#include "compare/calibration/photo_blur.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"

namespace culet {
namespace {

// A princess cut of glass under three lobes. Light without edges keeps the effect of a tilt linear
// for longer than windows do.
Scene glass() {
    Scene scene;
    scene.stone.solid = *with_facet_error(make_cut("princess"), radians(0.5), 4);
    scene.stone.material = catalogue_material("glass_bk7");
    scene.camera.position = {4, -3, 200};
    scene.camera.up = {0, 1, 0};
    scene.camera.orthographic_width = 9;
    scene.camera.width = scene.camera.height = 200;
    scene.lights.constant = 0.1;
    scene.lights.sources.push_back(CosinePowerLight{Vec3{0.3, 0.1, 1}, 8, {Rgb{1.2, 1.1, 1.0}}});
    scene.lights.sources.push_back(CosinePowerLight{Vec3{1, 0.3, 0.5}, 30, {Rgb{3.0, 2.8, 2.9}}});
    scene.lights.sources.push_back(
        CosinePowerLight{Vec3{-0.5, 0.9, 0.4}, 20, {Rgb{1.0, 1.2, 0.8}}});
    scene.settings.wavelengths_nm = {550};
    scene.settings.effects_auto = false;
    scene.camera = cropped_to_stone(scene.camera, scene.stone.solid, 150, 0.18);
    return scene;
}

CameraModel camera() {
    CameraModel camera;
    camera.gain = {0.6, 0.6, 0.6};
    camera.ground = {0.02f, 0.02f, 0.02f};
    return camera;
}

struct Bench {
    explicit Bench(const Scene& scene, int threads = 0)
        : model(scene), renderer(scene, 0.03), tilts(scene, renderer, camera(), threads) {}

    std::optional<double> read(const Solid& solid, std::uint64_t seed) const {
        Scene scene = model;
        scene.stone.solid = solid;
        const Photo photo = photographed(renderer.draw(scene), camera(), seed);
        const auto scores =
            scores_against(photo, softened(renderer.picture(), camera().psf_px), 150, &tilts);
        return scores.empty() ? std::nullopt : scores.back().value;
    }

    Scene model;
    DraftRenderer renderer;
    FacetTilts tilts;
};

// Without a calibration only a factor of 1.5 is required: the tilts of 33 facets, not all of them
// visible, scatter by 12 % and more.
TEST(FacetTilts, AreAboutTheFacetError) {
    const Bench bench(glass());
    ASSERT_TRUE(bench.tilts.usable());
    double before = 0;
    for (const double deg : {0.05, 0.1, 0.2}) {
        double logs = 0;
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const auto wrong = with_facet_error(bench.model.stone.solid, radians(deg), seed);
            const auto read = bench.read(*wrong, seed);
            ASSERT_TRUE(read) << deg << ", seed " << seed;
            logs += std::log(*read) / 4;
        }
        const double mean = std::exp(logs);
        EXPECT_GT(mean, deg / 1.5);
        EXPECT_LT(mean, deg * 1.5);
        EXPECT_GT(mean, before);
        before = mean;
    }
    // The model itself, moved and with noise.
    EXPECT_LT(*bench.read(bench.model.stone.solid, 9), 0.03);
}

TEST(FacetTilts, AreTheSameWhateverTheThreads) {
    const Bench one(glass(), 1), two(glass(), 2);
    const Solid wrong = *with_facet_error(one.model.stone.solid, radians(0.1), 3);
    EXPECT_EQ(*one.read(wrong, 5), *two.read(wrong, 5));
}

TEST(FacetTilts, OfAStoneInTheDarkAreNotKnown) {
    Scene scene = glass();
    scene.lights = {};
    const DraftRenderer renderer(scene, 0.03);
    EXPECT_FALSE(FacetTilts(scene, renderer, camera(), 0).usable());
}

TEST(FacetTilts, OfAStoneThatIsNotConvexAreNotKnown) {
    Scene scene = glass();
    const DraftRenderer renderer(scene, 0.03);
    for (std::size_t v = 0; v < scene.stone.solid.vertices.size(); v += 3)
        scene.stone.solid.vertices[v] *= 1.03;
    ASSERT_FALSE(is_convex(scene.stone.solid));
    const FacetTilts tilts(scene, renderer, camera(), 0);
    EXPECT_FALSE(tilts.usable());
}

TEST(FacetTilts, StopWhenTheyAreToldTo) {
    const Scene scene = glass();
    const DraftRenderer renderer(scene, 0.03);
    EXPECT_THROW(FacetTilts(scene, renderer, camera(), 0, [](double) { return false; }),
                 Interrupted);
}

}  // namespace
}  // namespace culet
