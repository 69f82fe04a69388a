#pragma once
// The numbers that the solver varies: those of `Layout`, less what is fixed (the up facet's
// normal), and of every orbit of an exact symmetry the first member only. Shapes stay whole: each
// move puts all images in their places again, so that symmetry holds to rounding.

#include <array>
#include <span>
#include <vector>

#include "fit/model/jacobian_rows.h"
#include "fit/model/orbits.h"
#include "fit/model/residuals.h"
#include "fit/model/shape.h"

namespace culet {

/// In which directions a facet's normal may tilt: any two across it, or the one within the vertical
/// plane through `outward` that an exact symmetry keeps it in.
std::array<Vec3, 2> tilt_directions(const Vec3& normal, int count, const Vec3& outward);

class Parameters {
public:
    /// `fixed_extras` are held where they are. `orbits` may be empty.
    Parameters(const Shape& shape, int up_facet, Orbits orbits,
               const std::vector<bool>& fixed_extras);

    int size() const { return size_; }
    const Orbits& orbits() const { return orbits_; }
    bool is_first_facet(int f) const { return orbits_.empty() || orbits_.facets[f].first == f; }
    bool is_first_point(int p) const { return orbits_.empty() || orbits_.points[p].first == p; }
    /// Number of points that go with a first member.
    int images_of_point(int p) const { return point_images_[p]; }

    /// What counts as a step of one, for each freedom.
    const std::vector<double>& metric() const { return metric_; }

    Shape retracted(const Shape& shape, std::span<const double> step) const;
    /// The same, but what the step turns the stone about z as a whole is done as a turn: readings
    /// may say so little of where azimuth begins that steps of many degrees are wanted.
    Shape retracted_with_turn(const Shape& shape, std::span<const double> step) const;
    /// All facets and points that are images of others back in their places.
    void place_images(Shape& shape) const;
    /// The nearest shape with the symmetry: the mean of what the motions make of it.
    Shape symmetrised(const Shape& shape) const;

    /// Columns and directions of one facet's or point's parameters: d(thing) = sum step_k along_k.
    struct Slots {
        int column = -1, count = 0;
        std::array<Vec3, 3> along{};
    };
    /// At one shape.
    struct TangentBasis {
        std::vector<Slots> normals, points;
        const std::vector<int>* offsets = nullptr;
        const std::vector<int>* extras = nullptr;
    };
    TangentBasis tangent_basis(const Shape& shape) const;

    /// Sums up one row; equal columns are merged.
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
