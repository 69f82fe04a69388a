#pragma once
// A stone as a scanner wrote it: `nv nf ne`, then `i x y z` for each vertex, then for each facet `i
// n a b c d` (a x + b y + c z + d = 0) and a line of its vertices; lines with # are comments.

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "stone/solid/solid.h"
#include "stone/text/errors.h"

namespace culet {

/// The solid that the planes enclose; the vertices are ignored. The scanner holds the table down,
/// so the solid is turned by half a turn about x. Throws InputError for an invalid file.
inline Solid scanned_solid(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first != std::string::npos && line[first] != '#') lines.push_back(line);
    }
    std::size_t vertices = 0, facets = 0;
    if (!lines.empty()) std::istringstream(lines[0]) >> vertices >> facets;
    if (facets < 4 || lines.size() < 1 + vertices + 2 * facets) {
        throw InputError(path, "is not a polyhedron of a scanner: vertices and facets are missing");
    }
    std::vector<NamedPlane> planes;
    for (std::size_t i = 0; i < facets; ++i) {
        int index = 0, sides = 0;
        double a = 0, b = 0, c = 0, d = 0;
        std::istringstream(lines[1 + vertices + 2 * i]) >> index >> sides >> a >> b >> c >> d;
        const Vec3 normal(a, -b, -c);
        planes.push_back(
            {fmt::format("f{}", i), {glm::normalize(normal), -d / glm::length(normal)}});
    }
    return intersect_half_spaces(planes).solid;
}

}  // namespace culet
