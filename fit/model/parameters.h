#pragma once
// The numbers that the solver varies: those of `Layout` without what is fixed (the up facet's
// normal), and only the first member of every orbit of an exact symmetry. Shapes stay complete:
// each move restores all images, so that symmetry holds to rounding.

#include <array>
#include <span>
#include <vector>

#include "fit/model/jacobian_rows.h"
#include "fit/model/orbits.h"
#include "fit/model/residuals.h"
#include "fit/model/shape.h"

namespace culet {

/// The directions in which a facet's normal may tilt: two tangents, or one within the vertical
/// plane through `outward` in which exact symmetry keeps it.
std::array<Vec3, 2> tilt_directions(const Vec3& normal, int count, const Vec3& outward);

class Parameters {
public:
    /// `fixed_extras` do not vary. `orbits` may be empty.
    Parameters(const Shape& shape, int up_facet, Orbits orbits,
               const std::vector<bool>& fixed_extras);

    int size() const { return size_; }
    const Orbits& orbits() const { return orbits_; }
    bool is_first_facet(int f) const { return orbits_.empty() || orbits_.facets[f].first == f; }
    bool is_first_point(int p) const { return orbits_.empty() || orbits_.points[p].first == p; }
    /// Size of the orbit of a first member.
    int images_of_point(int p) const { return point_images_[p]; }

    /// What counts as a step of one, for each parameter.
    const std::vector<double>& metric() const { return metric_; }

    Shape retracted(const Shape& shape, std::span<const double> step) const;
    /// The same, but applies the part of the step that turns the stone about z as a rotation. The
    /// azimuth may be so weakly observed that steps of many degrees occur.
    Shape retracted_with_turn(const Shape& shape, std::span<const double> step) const;
    /// Restores all facets and points that are images of others.
    void place_images(Shape& shape) const;
    /// The nearest symmetric shape: the mean over the motions.
    Shape symmetrised(const Shape& shape) const;

    /// Columns and directions of a facet's or point's parameters: d(thing) = sum step_k along_k.
    struct Slots {
        int column = -1, count = 0;
        std::array<Vec3, 3> along{};
    };
    /// The slots at one shape.
    struct TangentBasis {
        std::vector<Slots> normals, points;
        const std::vector<int>* offsets = nullptr;
        const std::vector<int>* extras = nullptr;
    };
    TangentBasis tangent_basis(const Shape& shape) const;

    /// Accumulates one row, merging equal columns.
    class Row {
    public:
        Row(const TangentBasis& tangent_basis, int size)
            : tangent_basis_(tangent_basis),
              sum_(std::size_t(size), 0.0),
              used_(std::size_t(size), false) {}
        void normal(int facet, const Vec3& slope);
        void offset(int facet, double slope);
        void point(int point, const Vec3& slope);
        void quantity(const Quantity& quantity);
        void close(JacobianRows& rows, double residual, double variance);

    private:
        void add(int column, double slope);
        const TangentBasis& tangent_basis_;
        std::vector<double> sum_;
        std::vector<char> used_;
        std::vector<int> columns_;
    };

private:
    Layout layout_;
    Orbits orbits_;
    int up_facet_ = -1, size_ = 0;
    std::vector<int> normal_column_, normal_count_, offset_column_, point_column_, point_count_,
        extra_column_, facet_images_, point_images_;
    std::vector<std::array<Vec3, 3>> point_along_;  // of first members
    std::vector<double> metric_;
};

}  // namespace culet
