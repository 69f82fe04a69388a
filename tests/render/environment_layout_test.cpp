// Lat-long and cube maps. Expectations: solid angles in closed form, OpenEXR's ImfEnvmap as an
// independent implementation of both layouts, conservation of energy.

#include "render/scene/environment_layout.h"

#include <ImathVec.h>
#include <ImfEnvmap.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace culet {
namespace {

EnvironmentMap lat_long(int width) {
    EnvironmentMap map;
    map.width = width;
    map.height = width / 2;
    map.rgb.assign(3 * static_cast<std::size_t>(width) * (width / 2), 0.0f);
    return map;
}

EnvironmentMap busy_map(int width, unsigned seed, int suns) {
    EnvironmentMap map = lat_long(width);
    std::mt19937_64 random(seed);
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
    for (float& v : map.rgb) v = static_cast<float>(0.1 * std::pow(20.0, uniform()));
    for (int s = 0; s < suns; ++s) {
        const std::size_t at = 3 * (random() % (map.rgb.size() / 3));
        for (std::size_t c = 0; c < 3; ++c) map.rgb[at + c] = static_cast<float>(5e4 * uniform());
    }
    return map;
}

void expect_same_energy(const Rgb& a, const Rgb& b) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(b[c] / a[c], 1, 1e-3) << c;
}

TEST(EnvironmentLayout, SolidAnglesFillTheSphere) {
    double lat = 0, cube = 0;
    for (int row = 0; row < 37; ++row) lat += 74 * lat_long_solid_angle(row, 74, 37);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) cube += 6 * cube_solid_angle(x, y, 9);
    EXPECT_NEAR(lat, 4 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(cube, 4 * std::numbers::pi, 1e-12);
}

// docs: the top row is +z, the middle column +x, azimuth grows to the left.
TEST(EnvironmentLayout, LatLongIsTheRenderers) {
    const Vec3 left = lat_long_direction(16, 16, 64, 32);
    EXPECT_NEAR(left.y, 1, 1e-12);
    EXPECT_NEAR(lat_long_direction(32, 16, 64, 32).x, 1, 1e-12);
    EXPECT_NEAR(lat_long_direction(7, 0, 64, 32).z, 1, 1e-12);
    EnvironmentMap map = busy_map(64, 3, 0);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            const Rgb seen = map.at(lat_long_direction(x + 0.5, y + 0.5, 64, 32));
            EXPECT_NEAR(seen[1], map.rgb[3 * (static_cast<std::size_t>(y) * 64 + x) + 1], 1e-5);
        }
    }
}

TEST(EnvironmentLayout, PlacesAndDirectionsAreInverse) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 d = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
        const MapPlace a = lat_long_place(d, 200, 100), b = cube_place(d, 50);
        EXPECT_LT(glm::length(lat_long_direction(a.column, a.row, 200, 100) - d), 1e-12);
        EXPECT_LT(glm::length(cube_direction(b.column, b.row, 50) - d), 1e-9);
    }
}

// culet's x, y, z are OpenEXR's Z, X, Y: its lat-long maps are centred on +Z with +X to the left,
// its cube maps are squares in a column.
TEST(EnvironmentLayout, IsWhatOpenexrReads) {
    std::mt19937_64 random(6);
    std::normal_distribution<double> normal;
    const int size = 32;
    const Imath::Box2i cube_window({0, 0}, {size - 1, 6 * size - 1}), lat_window({0, 0}, {127, 63});
    for (int i = 0; i < 500; ++i) {
        const Vec3 d = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
        const Imath::V3f exr(static_cast<float>(d.y), static_cast<float>(d.z),
                             static_cast<float>(d.x));
        Imf::CubeMapFace face;
        Imath::V2f in_face;
        Imf::CubeMap::faceAndPixelPosition(exr, cube_window, face, in_face);
        const Imath::V2f pixel = Imf::CubeMap::pixelPosition(face, cube_window, in_face);
        // OpenEXR puts the edges of a square on the centres of its outer pixels, culet on their
        // outer edges: half a pixel at most.
        const MapPlace place = cube_place(d, size);
        EXPECT_EQ(static_cast<int>(place.row) / size, static_cast<int>(face));
        EXPECT_NEAR(place.column - 0.5, pixel.x, 0.51);
        EXPECT_NEAR(place.row - 0.5, pixel.y, 0.51);
        const Imath::V2f lat = Imf::LatLongMap::pixelPosition(lat_window, exr);
        const MapPlace ours = lat_long_place(d, 128, 64);
        EXPECT_NEAR(ours.column - 0.5, lat.x, 0.51);
        EXPECT_NEAR(ours.row - 0.5, lat.y, 0.51);
    }
}

TEST(EnvironmentLayout, AConstantStaysThatConstant) {
    EnvironmentMap map = lat_long(64);
    for (float& v : map.rgb) v = 0.7f;
    for (const float v : cube_of_lat_long(map, 16).rgb) EXPECT_NEAR(v, 0.7f, 1e-6);
    EnvironmentMap cube = cube_of_lat_long(map, 16);
    for (const float v : lat_long_of_cube(cube, 64).rgb) EXPECT_NEAR(v, 0.7f, 1e-6);
}

TEST(EnvironmentLayout, EnergyIsKeptWithinAThousandth) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        for (const int suns : {0, 1, 20}) {
            const EnvironmentMap map = busy_map(128, seed, suns);
            for (const int size : {12, 32, 64}) {
                const EnvironmentMap cube = cube_of_lat_long(map, size);
                expect_same_energy(lat_long_energy(map), cube_energy(cube));
                expect_same_energy(cube_energy(cube), lat_long_energy(lat_long_of_cube(cube, 128)));
            }
        }
    }
}

// A sun must also keep its place: the light's first moment.
TEST(EnvironmentLayout, ASunStaysInItsPlace) {
    EnvironmentMap map = lat_long(256);
    map.rgb[3 * (40 * 256 + 100) + 1] = 1e5f;
    const Vec3 sun = lat_long_direction(100.5, 40.5, 256, 128);
    const EnvironmentMap cube = cube_of_lat_long(map, 64);
    Vec3 moment(0);
    double total = 0;
    for (int y = 0; y < 6 * 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double e = cube.rgb[3 * (static_cast<std::size_t>(y) * 64 + x) + 1] *
                             cube_solid_angle(x, y % 64, 64);
            moment += e * cube_direction(x + 0.5, y + 0.5, 64);
            total += e;
        }
    }
    EXPECT_LT(glm::length(moment / total - sun), 0.02);
}

}  // namespace
}  // namespace culet
