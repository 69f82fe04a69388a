#pragma once
// Edges of the stone as photographs show them: the [[line]] tables of a stone file.

#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "fit/readings/measurement.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Points on the picture of one edge, in pixels. The sum of their squared distances from any line
/// is that of its distance from `middle` and from a point `reach` away `along`, each times the
/// number of points, and `scatter`.
struct SeenLine {
    /// The place X of the mesh falls on the pixel (u/w, v/w) with (u, v, w) = projection (X, 1).
    glm::dmat4x3 projection{1};
    std::vector<glm::dvec2> points;
    std::string series;  ///< lines of one series were seen by cameras that stand fixed together
    glm::dvec2 middle{0, 0}, along{1, 0};
    double reach = 0, scatter = 0;
};

/// Throws InputError with what is wrong about the points.
SeenLine line_through(std::vector<glm::dvec2> points, const glm::dmat4x3& projection);

/// Returns one written reading of kind `line` for each table. Throws InputError with file and line.
std::vector<WrittenReading> read_lines(const TomlTable& root);

}  // namespace culet
