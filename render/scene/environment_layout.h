#pragma once
// Pictures of all directions: lat-long and cube maps, and from one to the other without losing
// light.
//
// Lat-long: the top row is +z, the middle column +x, azimuth grows to the left as seen from inside.
// Cube: OpenEXR's layout (ImfEnvmap.h), six squares from top to bottom; OpenEXR's axes X, Y (up), Z
// are culet's y, z, x, with which its lat-long maps and culet's are the same. The squares are then
// +y, -y, +z, -z, +x, -x.
// A texel's place (column, row) counts from the picture's corner: the first texel's middle is at
// (0.5, 0.5).

#include "render/scene/scene.h"

namespace culet {

/// Unit direction at a place of a lat-long map.
Vec3 lat_long_direction(double column, double row, int width, int height);

struct MapPlace {
    double column = 0, row = 0;
};
/// The place of a direction (of any length but 0): columns 0..width, rows 0..height.
MapPlace lat_long_place(const Vec3& direction, int width, int height);

/// Solid angle of one texel of a row: the cosine of the latitude, integrated.
double lat_long_solid_angle(int row, int width, int height);

/// Unit direction at a place of a cube map of six squares of `size` texels: 0 <= row < 6 size.
Vec3 cube_direction(double column, double row, int size);
MapPlace cube_place(const Vec3& direction, int size);
/// Solid angle of a texel of a square (the four-corner formula of Van Oosterom & Strackee 1983).
double cube_solid_angle(int column, int row, int size);

/// The sum over texels of radiance times solid angle, per colour: the light that a small white
/// ball in the middle would meet.
Rgb lat_long_energy(const EnvironmentMap& map);
Rgb cube_energy(const EnvironmentMap& cube);

/// Resampled over solid angles: a constant stays that constant, and the energy is kept, a sun of a
/// single texel included (what exceeds four times the mean is carried piece by piece; the rest is
/// sampled and brought to its total).
EnvironmentMap cube_of_lat_long(const EnvironmentMap& map, int size);
EnvironmentMap lat_long_of_cube(const EnvironmentMap& cube, int width);

}  // namespace culet
