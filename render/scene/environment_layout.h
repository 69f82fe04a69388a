#pragma once
// Lat-long and cube maps, and conversion between them without losing light.
//
// Lat-long: the top row is +z, the middle column +x; azimuth grows to the left as seen from inside.
// Cube: OpenEXR's layout (ImfEnvmap.h), six squares from top to bottom: +y, -y, +z, -z, +x, -x.
// OpenEXR's axes X, Y (up), Z are culet's y, z, x; lat-long maps are then the same in both.
// Places (column, row) count from the picture's corner: the first texel's centre is (0.5, 0.5).

#include "render/scene/scene.h"

namespace culet {

Vec3 lat_long_direction(double column, double row, int width, int height);

struct MapPlace {
    double column = 0, row = 0;
};
/// Place of a direction of any length but 0: columns 0..width, rows 0..height.
MapPlace lat_long_place(const Vec3& direction, int width, int height);

/// Solid angle of one texel of a row, integrated exactly.
double lat_long_solid_angle(int row, int width, int height);

/// Unit direction at a place of a cube map whose squares have `size` texels a side: 0 <= row < 6
/// size.
Vec3 cube_direction(double column, double row, int size);
MapPlace cube_place(const Vec3& direction, int size);
/// Solid angle of a texel of a square (four-corner formula, Van Oosterom & Strackee 1983).
double cube_solid_angle(int column, int row, int size);

/// Sum over texels of radiance times solid angle, per colour.
Rgb lat_long_energy(const EnvironmentMap& map);
Rgb cube_energy(const EnvironmentMap& cube);

/// Resamples by solid angle. Constant maps stay constant, and the energy is kept even of a
/// single-texel sun: light above four times the mean is moved piece by piece, the rest is sampled
/// and scaled to its total.
EnvironmentMap cube_of_lat_long(const EnvironmentMap& map, int size);
EnvironmentMap lat_long_of_cube(const EnvironmentMap& cube, int width);

}  // namespace culet
