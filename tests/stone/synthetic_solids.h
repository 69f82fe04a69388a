#pragma once
// Small solids with known figures.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet::test {

/// `word` and a number. Not by operator+, of which g++ 12 warns without cause (its bug 105329).
std::string numbered(const char* word, int number);

/// Edge length 2, centred on the origin.
std::vector<NamedPlane> cube_planes();
/// Facets at distance 1 / sqrt(3); corners at the unit vectors.
std::vector<NamedPlane> octahedron_planes();
/// Planes about the unit sphere in random directions, with distances of 1 to 1.2. More than about
/// twenty make a bounded solid.
std::vector<NamedPlane> random_planes(int count, std::uint64_t seed);

Solid cube();
Solid random_solid(int count, std::uint64_t seed);

/// Rotates by a fixed general angle, scales, then shifts both vertices and planes.
Solid moved(const Solid& solid, double scale, const Vec3& shift, bool turn = true);

/// Splits each facet into a fan of triangles with its name.
Solid triangulated(const Solid& solid);
Solid turned_inside_out(const Solid& solid);

/// The largest difference between facets of the same name: of unit normals, and of offsets over the
/// diameter. Infinite when the names differ.
double plane_difference(const Solid& a, const Solid& b);

/// The `.asc` designs in a folder, and those of the repository.
std::vector<std::filesystem::path> designs_in(const std::filesystem::path& folder);
std::vector<std::filesystem::path> committed_designs();

/// A GemCad `.gem` file of the solid's planes, without corners; mirrored, of order 4.
std::string gem_bytes(const Solid& solid, int gear, double refractive_index);

void write_bytes(const std::filesystem::path& file, const std::string& bytes);

}  // namespace culet::test
