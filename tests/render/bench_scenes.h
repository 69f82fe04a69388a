#pragma once
// The scenes on which the beams are measured.
//
// The base case is a diamond round brilliant of 57 + 16 facets, seen from 6 diameters away and
// tilted by 20 degrees, so that its bounding sphere touches the picture's edges. Lights: 0.1 from
// everywhere and three lobes with a peak radiance of 5.

#include <random>
#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

struct BenchStone {
    std::string name;
    Solid solid;
};

/// 57, 73 (the base case's), 121 and 304 facets. The last two are ringed stones.
std::vector<BenchStone> bench_stones();

/// A table, and rings of planes tangent to two half ellipsoids with the semi-axes 1 and `crown` or
/// `pavilion`. Each ring is turned by half a facet against the one before. Throws InternalError if
/// a plane holds no facet.
struct Ring {
    int facets;
    double latitude_deg;  ///< of the normals: 90 is up, -90 down
};
Solid ringed_stone(const std::vector<Ring>& rings, double crown, double pavilion);

Camera bench_camera(const Solid& solid, double diameters, const Vec3& towards_eye, int pixels);
/// The base case's: 20 degrees from the table's normal.
Vec3 bench_view();
Vec3 random_view(std::mt19937_64& random);

/// Lobes without any edge. `peak`: radiance of the brightest lobe.
Lights smooth_lights(double peak = 5);

/// Three planes and two spheres around a stone of this size, as in Voelker & Hamann's fig. 9.
/// Radiance is at most 0.9, which a PNG can hold.
Lights near_lights(double diameter);

/// 800 x 800 without --pixels, depth 8, one wavelength, nothing pruned.
Scene base_scene(int pixels);
void set_polarised(Scene& scene, bool polarised);

}  // namespace culet
