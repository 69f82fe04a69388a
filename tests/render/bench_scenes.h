#pragma once
// The scenes that the beams are measured on.
//
// The base case: a round brilliant of 57 + 16 facets, diamond, seen from 6 of its diameters away,
// tilted by 20 degrees, so that its bounding sphere touches the picture's edges; a light of 0.1
// from everywhere and three lobes, of radiance 5 at the brightest.

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
/// `pavilion`; each ring is turned against the one before by half a facet. Every plane must hold a
/// facet: else InternalError.
struct Ring {
    int facets;
    double latitude_deg;  ///< of the normals: 90 up, -90 down
};
Solid ringed_stone(const std::vector<Ring>& rings, double crown, double pavilion);

/// From `diameters` away, in direction `towards_eye` from the stone's middle.
Camera bench_camera(const Solid& solid, double diameters, const Vec3& towards_eye, int pixels);
/// Of the base case: 20 degrees from the table's normal.
Vec3 bench_view();
Vec3 random_view(std::mt19937_64& random);

/// `peak`: radiance where the brightest lobe is. Lobes alone: nothing with an edge.
Lights smooth_lights(double peak = 5);

/// Three planes and two spheres about a stone of this size, as Voelker & Hamann light theirs for
/// fig. 9; radiance 0.9 at most, which a PNG holds.
Lights near_lights(double diameter);

/// 800 x 800 without --pixels, depth 8, one wavelength, nothing cut.
Scene base_scene(int pixels);
void set_polarised(Scene& scene, bool polarised);

}  // namespace culet
