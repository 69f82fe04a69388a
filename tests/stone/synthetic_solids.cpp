#include "tests/stone/synthetic_solids.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <random>

namespace culet::test {

std::vector<std::filesystem::path> designs_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (entry.path().extension() == ".asc") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string numbered(const char* word, int number) {
    std::string name = word;
    return name.append(std::to_string(number));
}

std::vector<NamedPlane> cube_planes() {
    return {{"px", {{1, 0, 0}, 1}},  {"mx", {{-1, 0, 0}, 1}}, {"py", {{0, 1, 0}, 1}},
            {"my", {{0, -1, 0}, 1}}, {"pz", {{0, 0, 1}, 1}},  {"mz", {{0, 0, -1}, 1}}};
}

std::vector<NamedPlane> octahedron_planes() {
    std::vector<NamedPlane> planes;
    for (int i = 0; i < 8; ++i) {
        const Vec3 n(i & 1 ? -1 : 1, i & 2 ? -1 : 1, i & 4 ? -1 : 1);
        planes.push_back({numbered("o", i), {n / std::sqrt(3.0), 1 / std::sqrt(3.0)}});
    }
    return planes;
}

std::vector<NamedPlane> random_planes(int count, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> distance(1, 1.2);
    std::vector<NamedPlane> planes;
    for (int i = 0; i < count; ++i) {
        const double x = normal(generator), y = normal(generator), z = normal(generator);
        planes.push_back({numbered("p", i), {glm::normalize(Vec3(x, y, z)), distance(generator)}});
    }
    return planes;
}

Solid cube() {
    return intersect_half_spaces(cube_planes()).solid;
}

Solid random_solid(int count, std::uint64_t seed) {
    return intersect_half_spaces(random_planes(count, seed)).solid;
}

Solid moved(const Solid& solid, double scale, const Vec3& shift, bool turn) {
    // About the axis (1, 2, 2) / 3 by 0.7 rad (Rodrigues).
    const Vec3 axis = Vec3(1, 2, 2) / 3.0;
    const double c = std::cos(0.7), s = std::sin(0.7);
    const auto turned = [&](const Vec3& v) {
        if (!turn) return v;
        return c * v + s * glm::cross(axis, v) + (1 - c) * glm::dot(axis, v) * axis;
    };
    Solid result = solid;
    for (Vec3& v : result.vertices) v = scale * turned(v) + shift;
    for (Facet& facet : result.facets) {
        facet.plane.normal = turned(facet.plane.normal);
        facet.plane.offset = scale * facet.plane.offset + glm::dot(facet.plane.normal, shift);
    }
    return result;
}

Solid triangulated(const Solid& solid) {
    Solid result;
    result.vertices = solid.vertices;
    for (const Facet& facet : solid.facets) {
        for (std::size_t i = 1; i + 1 < facet.corners.size(); ++i) {
            result.facets.push_back({facet.name,
                                     facet.plane,
                                     {facet.corners[0], facet.corners[i], facet.corners[i + 1]}});
        }
    }
    return result;
}

Solid turned_inside_out(const Solid& solid) {
    Solid result = solid;
    for (Facet& facet : result.facets) {
        std::reverse(facet.corners.begin(), facet.corners.end());
        facet.plane.normal = -facet.plane.normal;
        facet.plane.offset = -facet.plane.offset;
    }
    return result;
}

double plane_difference(const Solid& a, const Solid& b) {
    if (a.facets.size() != b.facets.size()) return INFINITY;
    const double size = diameter(a);
    double worst = 0;
    for (const Facet& facet : a.facets) {
        const int other = find_facet(b, facet.name);
        if (other < 0) return INFINITY;
        const Plane &p = facet.plane, &q = b.facets[other].plane;
        worst = std::max(
            {worst, glm::length(p.normal - q.normal), std::abs(p.offset - q.offset) / size});
    }
    return worst;
}

std::vector<std::filesystem::path> committed_designs() {
    return designs_in(CULET_SOURCE_DIR "/tests/stone/designs");
}

std::string gem_bytes(const Solid& solid, int gear, double refractive_index) {
    std::string gem;
    const auto add = [&](const auto& value) {
        gem.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    for (const Facet& facet : solid.facets) {
        for (int axis = 0; axis < 3; ++axis) add(facet.plane.normal[axis] / facet.plane.offset);
        add(std::int32_t{1});
        gem.push_back(static_cast<char>(facet.name.size()));
        gem += facet.name;
        add(std::int32_t{0});
    }
    add(-99999.0);
    for (const std::int32_t word : {4, 1, gear}) add(word);
    add(refractive_index);
    add(std::int32_t{32767});
    add(0.0);
    return gem.append(8, '\0');
}

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace culet::test
