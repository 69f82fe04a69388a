// Expectations: closed forms, and laws that hold for every stone.

#include "render/uncertainty/picture_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "render/render.h"
#include "stone/text/errors.h"

namespace {

using namespace culet;

constexpr double k_index = 1.5, k_absorption = 0.5, k_depth = 2;

Solid box_stone() {
    const std::vector<NamedPlane> planes{
        {"T", {{0, 0, 1}, k_depth / 2}}, {"B", {{0, 0, -1}, k_depth / 2}},
        {"E", {{1, 0, 0}, 3}},           {"W", {{-1, 0, 0}, 3}},
        {"N", {{0, 1, 0}, 3}},           {"S", {{0, -1, 0}, 3}}};
    return intersect_half_spaces(planes).solid;
}

Scene plate_scene() {
    Scene scene;
    scene.stone.solid = box_stone();
    scene.stone.material.index[0].n = k_index;
    scene.stone.material.absorption_per_mm[0] = Spectrum{{400, 700}, {k_absorption, k_absorption}};
    scene.camera.position = {0, 0, 20};
    scene.camera.orthographic_width = 1;
    scene.camera.width = scene.camera.height = 8;
    scene.lights.sources.push_back(HemisphereLight{{0, 0, -1}, {}});
    scene.settings.wavelengths_nm = {589};
    scene.settings.engine = "beams";
    scene.settings.check = Check::none;
    scene.settings.depth = 12;
    scene.settings.samples = 1;
    return scene;
}

ScenePlan as_it_is(const Scene& scene) {
    ScenePlan plan;
    plan.settings = scene.settings;
    return plan;
}

StoneUncertainty exact(const Solid& solid) {
    StoneUncertainty uncertainty;
    uncertainty.facets.resize(solid.facets.size());
    return uncertainty;
}

FacetUncertainty& facet(StoneUncertainty& uncertainty, const Solid& solid, const char* name) {
    return uncertainty.facets[static_cast<std::size_t>(find_facet(solid, name))];
}

constexpr std::size_t k_middle = 4 * 8 + 4;

// A plate of thickness d that absorbs a per length and reflects R at each face: incoherent
// reflections sum to L = (1 - R)^2 t / (1 - R^2 t^2), t = exp(-a d), whose logarithm falls by a (1
// + R^2 t^2) / (1 - R^2 t^2) per length. A table position error of sigma gives that times L times
// sigma.
TEST(PictureUncertainty, OfAPlateIsSlopeTimesSigma) {
    const Scene scene = plate_scene();
    StoneUncertainty uncertainty = exact(scene.stone.solid);
    const double sigma = 0.01;
    facet(uncertainty, scene.stone.solid, "T").offset = sigma;
    const int draws = 200;
    const PictureUncertainty found =
        picture_uncertainty(scene, as_it_is(scene), uncertainty, draws);
    EXPECT_EQ(found.draws, draws);
    EXPECT_EQ(found.left_out, 0);
    const double reflected = std::pow((k_index - 1) / (k_index + 1), 2);
    const double t = std::exp(-k_absorption * k_depth), rt = reflected * reflected * t * t;
    const double light = std::pow(1 - reflected, 2) * t / (1 - rt);
    const double expected = light * k_absorption * (1 + rt) / (1 - rt) * sigma;
    // Four standard errors of a mean and of a standard deviation. The curvature of the exponential
    // adds a relative (a sigma)^2 / 2 = 1e-5.
    EXPECT_NEAR(double(found.mean[3 * k_middle]), light, 4 * expected / std::sqrt(draws));
    EXPECT_NEAR(double(found.sigma_luminance[k_middle]) / expected, 1,
                4 / std::sqrt(2.0 * (draws - 1)));
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(double(found.sigma[3 * k_middle + c]), double(found.sigma_luminance[k_middle]),
                    1e-3 * expected);
}

// The light falls monotonically with the thickness, so its quantiles are those of a normal
// distribution. A quantile's standard error is sqrt(p (1 - p) / n) over the density there: for 200
// draws 0.107 sigma at one sigma and 0.195 at two.
TEST(PictureUncertainty, BandsOfANormalDistribution) {
    const Scene scene = plate_scene();
    StoneUncertainty uncertainty = exact(scene.stone.solid);
    facet(uncertainty, scene.stone.solid, "T").offset = 0.01;
    const PictureUncertainty found = picture_uncertainty(scene, as_it_is(scene), uncertainty, 200);
    const double mean = double(found.mean[3 * k_middle]),
                 sigma = double(found.sigma_luminance[k_middle]);
    const double expected[] = {-2, -1, 1, 2}, error[] = {0.195, 0.107, 0.107, 0.195};
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR((double(found.bands[4 * k_middle + k]) - mean) / sigma, expected[k],
                    4 * error[k])
            << k;
}

// If table and floor move together the thickness stays: their sum's variance is 2 sigma^2 (1 +
// correlation).
TEST(PictureUncertainty, KnowsCorrelatedFacets) {
    const Scene scene = plate_scene();
    const Solid& solid = scene.stone.solid;
    const std::size_t size = 3 * solid.facets.size();
    StoneUncertainty uncertainty = exact(solid);
    uncertainty.covariance.assign(size * size, 0);
    const std::size_t t = 3 * std::size_t(find_facet(solid, "T")) + 2,
                      b = 3 * std::size_t(find_facet(solid, "B")) + 2;
    const double variance = 1e-4;
    const auto sigma_with = [&](double correlation) {
        for (const auto& [i, j, share] :
             {std::tuple(t, t, 1.0), {b, b, 1.0}, {t, b, correlation}, {b, t, correlation}})
            uncertainty.covariance[i * size + j] = share * variance;
        return double(picture_uncertainty(scene, as_it_is(scene), uncertainty, 200)
                          .sigma_luminance[k_middle]);
    };
    const double apart = sigma_with(0);
    EXPECT_NEAR(sigma_with(1) / apart, std::sqrt(2.0), 4 * std::sqrt(2.0) * 0.071);
    // To single precision of the picture.
    EXPECT_LT(sigma_with(-1), 1e-4 * apart);
}

// In light that is the same from everywhere every stone without absorption looks the same.
TEST(PictureUncertainty, IsNothingInAFurnace) {
    Scene scene = plate_scene();
    scene.lights = {};
    scene.lights.constant = 1;
    scene.stone.material.absorption_per_mm[0] = {};
    scene.settings.depth = 60;
    StoneUncertainty uncertainty = exact(scene.stone.solid);
    for (FacetUncertainty& f : uncertainty.facets) f = {0.01, 0.01, 0.01};
    const PictureUncertainty found = picture_uncertainty(scene, as_it_is(scene), uncertainty, 10);
    // Pruned and remaining light is within the tolerance of the settings.
    EXPECT_NEAR(double(found.mean[3 * k_middle]), 1, scene.settings.tolerance);
    EXPECT_LT(double(found.sigma_luminance[k_middle]), scene.settings.tolerance);
}

// A stone on its side turns about its own up direction: the picture of the turned scene is that of
// the upright one.
TEST(PictureUncertainty, GoesWithTheStonesOwnUp) {
    const Scene upright = plate_scene();
    Scene lying = upright;
    const auto laid = [](const Vec3& v) { return Vec3{v.z, v.y, -v.x}; };
    for (Vec3& v : lying.stone.solid.vertices) v = laid(v);
    for (Facet& f : lying.stone.solid.facets) f.plane.normal = laid(f.plane.normal);
    lying.stone.up = {1, 0, 0};
    lying.camera.position = {20, 0, 0};
    lying.lights.sources = {HemisphereLight{{-1, 0, 0}, {}}};
    StoneUncertainty uncertainty = exact(upright.stone.solid);
    facet(uncertainty, upright.stone.solid, "T") = {0.002, 0, 0.01};
    const PictureUncertainty one = picture_uncertainty(upright, as_it_is(upright), uncertainty, 20),
                             other = picture_uncertainty(lying, as_it_is(lying), uncertainty, 20);
    EXPECT_NEAR(double(one.sigma_luminance[k_middle]), double(other.sigma_luminance[k_middle]),
                1e-3 * double(one.sigma_luminance[k_middle]));
}

TEST(PictureUncertainty, IsTheSameOnAnyNumberOfThreads) {
    Scene scene = plate_scene();
    StoneUncertainty uncertainty = exact(scene.stone.solid);
    facet(uncertainty, scene.stone.solid, "T") = {0.01, 0, 0.01};
    scene.settings.threads = 1;
    const PictureUncertainty one = picture_uncertainty(scene, as_it_is(scene), uncertainty, 5);
    scene.settings.threads = 3;
    const PictureUncertainty three = picture_uncertainty(scene, as_it_is(scene), uncertainty, 5);
    EXPECT_EQ(one.mean, three.mean);
    EXPECT_EQ(one.sigma, three.sigma);
    Picture picture;
    picture.width = picture.height = 8;
    add_layers(one, picture);
    ASSERT_EQ(picture.planes.size(), 11u);
    EXPECT_EQ(picture.planes[6].channel, "sigma.Y");
    EXPECT_EQ(picture.planes[10].channel, k_band_channels[3]);
    EXPECT_EQ(picture.planes[7].values[k_middle], one.bands[4 * k_middle]);
}

TEST(PictureUncertainty, RefusesWhatItCannotDraw) {
    Scene scene = plate_scene();
    const StoneUncertainty uncertainty = exact(scene.stone.solid);
    scene.stone.convex = false;
    EXPECT_THROW(picture_uncertainty(scene, as_it_is(scene), uncertainty, 3), InputError);
}

}  // namespace
