#include "stone/largest_inside.h"

#include <CGAL/MP_Float.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "stone/errors.h"

namespace culet {

LargestInside largest_inside(const Solid& cut, const Solid& stone) {
    // Variables: the scale, then the shift; for every plane of the stone
    //   scale * (furthest of the cut along its normal) + normal . shift <= offset.
    CGAL::Quadratic_program<double> programme(CGAL::SMALLER, false, 0, false, 0);
    programme.set_l(0, true, 0);
    for (std::size_t f = 0; f < stone.facets.size(); ++f) {
        const Plane& plane = stone.facets[f].plane;
        double furthest = -diameter(cut);
        for (std::size_t v = 0; v < cut.vertices.size(); ++v) {
            const double reach = glm::dot(plane.normal, cut.vertices[v]);
            furthest = v == 0 ? reach : std::max(furthest, reach);
        }
        const int row = static_cast<int>(f);
        programme.set_a(0, row, furthest);
        for (int k = 0; k < 3; ++k) programme.set_a(k + 1, row, plane.normal[k]);
        programme.set_b(row, plane.offset);
    }
    programme.set_c(0, -1);
    const auto solution = CGAL::solve_linear_program(programme, CGAL::MP_Float());
    if (!solution.is_optimal()) throw InternalError("a convex stone holds no copy of a cut");
    LargestInside inside;
    auto value = solution.variable_values_begin();
    inside.scale = CGAL::to_double(*value);
    for (int k = 0; k < 3; ++k) inside.shift[k] = CGAL::to_double(*++value);
    inside.volume = inside.scale * inside.scale * inside.scale * volume(cut);
    return inside;
}

Solid moved_inside(Solid cut, const LargestInside& inside) {
    for (Vec3& vertex : cut.vertices) vertex = inside.scale * vertex + inside.shift;
    for (Facet& facet : cut.facets)
        facet.plane.offset =
            inside.scale * facet.plane.offset + glm::dot(facet.plane.normal, inside.shift);
    return cut;
}

}  // namespace culet
