#pragma once
// Edges in photographs, as the model sees them. The cameras of one series stand fixed together, but
// nobody knows exactly how the mesh stands before them, nor, from pictures, how large it is. Each
// series therefore has seven unknowns: its motion.

#include <array>
#include <glm/mat4x4.hpp>
#include <vector>

#include "fit/model/frame.h"
#include "fit/model/residuals.h"
#include "fit/readings/measurement.h"

namespace culet {

/// The picture of one edge, in coordinates of its reading: along the seen line and across it, from
/// the middle of its points.
struct LineView {
    int left = -1, right = -1;  ///< the edge's facets
    int motion = -1;            ///< of the series: index of its first extra unknown
    /// A plane p with normal . x = offset is the four numbers (normal, -offset). The planes p and q
    /// cross in a line whose picture l . (along, across, 1) = 0 has l_k = p . pencil_k q (Hartley
    /// & Zisserman 2003, 8.2).
    std::array<glm::dmat4, 3> pencils{};
    double reach = 0;  ///< from the middle to where the points tell the line's direction
};

/// The picture of the edge, with (l.x, l.y) of length one.
Vec3 picture_of(const LineView& view, const Shape& shape);

class LineViews {
public:
    LineViews() = default;
    /// Appends the motions of all series to the extra unknowns of `shape`.
    LineViews(const Frame& frame, const std::vector<Reading>& readings, Shape& shape);

    /// Null if the reading is no line.
    const LineView* of(std::size_t reading) const;
    /// The first extra unknown of each motion. Its seven are the turn (tan of half the angle, along
    /// its axis), the shift, and the logarithm of the size: x becomes size * turn * x + shift.
    const std::vector<int>& motions() const { return motions_; }
    static constexpr int k_unknowns = 7;
    /// Without a facet that defines up, up is a direction before the cameras too: no motion tilts
    /// it.
    bool know_up() const { return know_up_; }

private:
    bool know_up_ = false;
    std::vector<LineView> views_;
    std::vector<int> view_of_;  // by reading, or -1
    std::vector<int> motions_;
};

/// By how much a motion's unknowns change where the stone turns about `axis` or shifts along it, so
/// that pictures stay the same.
std::array<double, LineViews::k_unknowns> following(const Shape& shape, int motion, bool turns,
                                                    const Vec3& axis);

}  // namespace culet
