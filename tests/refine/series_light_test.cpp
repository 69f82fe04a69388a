// The light of a simulated series, drawn by the reference engine in an environment map that is made
// from the zones' definition, with the camera of picture_axes.

#include "refine/spin/series_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "refine/spin/zone_shares.h"
#include "render/render.h"
#include "render/scene/environment_layout.h"
#include "stone/numbers/units.h"
#include "tests/fit/test_stones.h"
#include "tests/refine/spin_frames.h"

namespace culet {
namespace {

// 0.1 to 0.8, neighbours unlike each other; the camera is dark.
double true_radiance(std::size_t zone) {
    return zone + 1 == light_zones().size() ? 0.05 : 0.1 + 0.05 * double(zone * 4 % 15);
}

std::size_t zone_at(const Vec3& direction, const PictureAxes& at) {
    const Vec3 toward = glm::normalize(at.nearing);
    if (glm::dot(direction, toward) > std::cos(k_camera_cap)) return light_zones().size() - 1;
    const double elevation = std::asin(direction.z);
    const double azimuth = std::atan2(direction.y, direction.x) - std::atan2(toward.y, toward.x);
    for (std::size_t z = 0; z + 1 < light_zones().size(); ++z) {
        const LightZone& zone = light_zones()[z];
        const double middle = (zone.from_azimuth + zone.to_azimuth) / 2;
        if (elevation >= zone.from_elevation && elevation <= zone.to_elevation &&
            std::abs(std::remainder(azimuth - middle, 2 * std::numbers::pi)) <=
                (zone.to_azimuth - zone.from_azimuth) / 2 + 1e-9)
            return z;
    }
    ADD_FAILURE() << "no zone at elevation " << elevation;
    return 0;
}

LevelPicture drawn(const synthetic::SpinTruth& truth, const Material& material, double turn) {
    const PictureAxes at = picture_axes(truth.series.camera, turn);
    auto map = std::make_shared<EnvironmentMap>(EnvironmentMap{1024, 512, {}});
    for (int y = 0; y < map->height; ++y) {
        for (int x = 0; x < map->width; ++x)
            map->rgb.insert(
                map->rgb.end(), 3,
                float(true_radiance(
                    zone_at(lat_long_direction(x + 0.5, y + 0.5, map->width, map->height), at))));
    }
    Scene scene;
    scene.stone.solid = truth.solid;
    scene.stone.material = material;
    scene.lights.environment = map;
    const double distance = 1 / truth.series.camera.perspective;
    scene.camera.position = distance * glm::normalize(at.nearing);
    scene.camera.up = at.along;
    scene.camera.width = scene.camera.height = truth.size;
    scene.camera.fov = 2 * std::atan(truth.size / 2.0 / distance);
    scene.camera.principal_point = {truth.size / 2.0 + at.dx, truth.size / 2.0 - at.dy};
    scene.settings.engine = k_reference_engine;
    scene.settings.samples = 4;
    scene.settings.wavelengths_nm = {589.3};
    scene.settings.effects_auto = false;
    scene.settings.effects = {};
    LevelPicture picture{truth.size, truth.size, {}};
    for (const float light : render(scene).picture.rgb)
        picture.rgb.push_back(
            std::uint8_t(std::lround(255 * srgb_encoded(std::clamp(double(light), 0.0, 1.0)))));
    return picture;
}

// Every fifth frame is left out.
struct LitSeries {
    synthetic::SpinTruth truth = synthetic::lying_step_cut(15);
    Material material = catalogue_material("diamond");
    std::vector<SpinFrame> frames;
    SpinResult found;

    LitSeries() {
        found.solid = truth.solid;
        found.camera = truth.series.camera;
        found.proportions = {{"width", width_along(truth.solid, {1, 0, 0}), 0, true}};
        for (const double turn : truth.series.turns) {
            const bool held_out = frames.size() % 5 == 2;
            frames.push_back({"", drawn(truth, material, turn), held_out});
            SpinFrameResult& frame = found.frames.emplace_back();
            frame.used = !held_out;
            frame.turn = turn;
            frame.projection =
                projection_of(picture_axes(truth.series.camera, turn), {}, frames.back().picture);
        }
    }
};

const LitSeries& lit_series() {
    static const LitSeries series;
    return series;
}

// The map blurs zones' edges by its texel, 0.35 degrees, of the 15 that the camera's cap leaves of
// the narrowest zone's width; neighbours differ by 0.75 at most.
TEST(SeriesLight, FindsTheLightWithWhichFramesWereDrawn) {
    const LitSeries& series = lit_series();
    const SeriesLight light = series_light(series.frames, series.found, series.material);
    EXPECT_EQ(light.frames, 12);
    ASSERT_EQ(light.zones.size(), light_zones().size());
    for (std::size_t z = 0; z < light.zones.size(); ++z) {
        for (const double radiance : light.zones[z].radiance)
            EXPECT_NEAR(radiance, true_radiance(z), 0.02) << light.zones[z].name;
    }
    ASSERT_EQ(light.left_out.size(), 3u);
    for (const FrameLikeness& frame : light.left_out) {
        EXPECT_TRUE(series.frames[frame.frame].held_out);
        EXPECT_GT(*frame.zncc.value, 0.98);
        EXPECT_GT(*frame.zncc.z, k_beyond_chance);
    }
    EXPECT_NE(light.verdict.find("looks like the frames"), std::string::npos) << light.verdict;
}

TEST(SeriesLight, AStoneTiltedByTwoDegreesLooksLessLikeIt) {
    const LitSeries& series = lit_series();
    SpinResult tilted = series.found;
    tilted.solid = test::off_standard(series.truth.solid, 2, 0, 5);
    const SeriesLight light = series_light(series.frames, tilted, series.material);
    EXPECT_LT(*light.mean.value, 0.7);
}

TEST(SeriesLight, AStoneTurnedTheWrongWayLooksLikeChance) {
    const LitSeries& series = lit_series();
    SpinResult turned = series.found;
    for (std::size_t f = 0; f < series.frames.size(); ++f)
        turned.frames[f].projection = series.found.frames[(f + 7) % 15].projection;
    const SeriesLight light = series_light(series.frames, turned, series.material);
    EXPECT_LT(*light.mean.z, k_beyond_chance);
    EXPECT_NE(light.verdict.find("by chance"), std::string::npos) << light.verdict;
}

TEST(SeriesLight, DoesNotDependOnThreads) {
    const LitSeries& series = lit_series();
    const SeriesLight all = series_light(series.frames, series.found, series.material),
                      one = series_light(series.frames, series.found, series.material, 1);
    for (std::size_t z = 0; z < all.zones.size(); ++z)
        EXPECT_EQ(all.zones[z].radiance, one.zones[z].radiance);
    EXPECT_EQ(all.mean.null, one.mean.null);
    EXPECT_EQ(all.beside, one.beside);
}

}  // namespace
}  // namespace culet
