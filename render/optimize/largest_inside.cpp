#include "render/optimize/largest_inside.h"

#include <Eigen/Core>
#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "stone/text/errors.h"

namespace culet {

namespace {

using Point = Eigen::Vector4d;  // scale, then the shift relative to the stone's diameter

struct Rows {
    Eigen::Matrix<double, Eigen::Dynamic, 4> a;
    Eigen::VectorXd b;  // a x <= b
};

using Columns = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, 4>;

// Least-squares coefficients of a point in independent columns. Gram-Schmidt done twice is accurate
// enough (Kahan, in Parlett 1980, 6.9) and, for four numbers a column, faster than a general
// decomposition.
Eigen::VectorXd shares_of(const Columns& columns, const Point& point) {
    const Eigen::Index count = columns.cols();
    Columns basis = columns;
    Eigen::Matrix4d upper = Eigen::Matrix4d::Zero();  // columns = basis * upper
    for (Eigen::Index k = 0; k < count; ++k) {
        for (int time = 0; time < 2; ++time) {
            for (Eigen::Index j = 0; j < k; ++j) {
                const double along = basis.col(j).dot(basis.col(k));
                basis.col(k) -= along * basis.col(j);
                upper(j, k) += along;
            }
        }
        upper(k, k) = basis.col(k).norm();
        basis.col(k) /= upper(k, k);
    }
    Eigen::VectorXd shares(count);
    for (Eigen::Index k = count - 1; k >= 0; --k) {
        shares[k] = basis.col(k).dot(point);
        for (Eigen::Index j = k + 1; j < count; ++j) shares[k] -= upper(k, j) * shares[j];
        shares[k] /= upper(k, k);
    }
    return shares;
}

// Zero for directions and multipliers; rows and objective have entries of order one.
constexpr double k_zero = 1e-11;

// Primal active-set method (Nocedal and Wright, Numerical Optimization, 2006, ch. 16.5, without a
// quadratic term) from a feasible point. Bland's rule (lowest index first) prevents cycling.
Point with_largest_scale(const Rows& rows, Point x) {
    const Point objective = Point::Unit(0);
    std::vector<Eigen::Index> active;
    const Eigen::Index most_steps = 100 * (rows.b.size() + 4);
    for (Eigen::Index step = 0; step < most_steps; ++step) {
        // Split the objective into a combination of active rows and a free direction.
        Columns normals(4, active.size());
        for (std::size_t k = 0; k < active.size(); ++k)
            normals.col(static_cast<Eigen::Index>(k)) = rows.a.row(active[k]).transpose();
        const Eigen::VectorXd multipliers = shares_of(normals, objective);
        // A row joins only if it is independent of all active ones, so four leave no direction.
        Point along = Point::Zero();
        if (active.size() < 4) along = objective - normals * multipliers;
        if (along.norm() < k_zero) {
            const auto hinders = std::find_if(multipliers.begin(), multipliers.end(),
                                              [](double one) { return one < -k_zero; });
            if (hinders == multipliers.end()) return x;
            active.erase(active.begin() + (hinders - multipliers.begin()));
            continue;
        }
        double longest = std::numeric_limits<double>::infinity();
        Eigen::Index blocking = -1;
        for (Eigen::Index row = 0; row < rows.b.size(); ++row) {
            const double closing = rows.a.row(row).dot(along);
            if (closing < k_zero * along.norm() || std::ranges::count(active, row) > 0) continue;
            const double length = std::max(0.0, rows.b[row] - rows.a.row(row).dot(x)) / closing;
            if (length < longest) {
                longest = length;
                blocking = row;
            }
        }
        if (blocking < 0) break;
        x += longest * along;
        active.insert(std::ranges::lower_bound(active, blocking), blocking);
    }
    throw InternalError("a convex stone holds no largest copy of a cut");
}

}  // namespace

LargestInside largest_inside(const Solid& cut, const Solid& stone) {
    // Both solids are taken about their centroids, so that scale 0 is feasible. For every plane of
    // the stone
    //   scale * (furthest of the cut along its normal) + normal . shift <= offset.
    const Vec3 middle_of_cut = centroid(cut), middle_of_stone = centroid(stone);
    const double size = diameter(stone);
    const auto count = static_cast<Eigen::Index>(stone.facets.size());
    Rows rows{Eigen::Matrix<double, Eigen::Dynamic, 4>(count, 4), Eigen::VectorXd(count)};
    for (Eigen::Index f = 0; f < count; ++f) {
        const Plane& plane = stone.facets[static_cast<std::size_t>(f)].plane;
        double furthest = 0;
        for (const Vec3& vertex : cut.vertices)
            furthest = std::max(furthest, glm::dot(plane.normal, vertex - middle_of_cut));
        rows.a.row(f) << furthest / size, plane.normal.x, plane.normal.y, plane.normal.z;
        rows.b[f] = (plane.offset - glm::dot(plane.normal, middle_of_stone)) / size;
    }
    const Point best = with_largest_scale(rows, Point::Zero());
    LargestInside inside;
    inside.scale = best[0];
    inside.shift =
        middle_of_stone + size * Vec3{best[1], best[2], best[3]} - inside.scale * middle_of_cut;
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
