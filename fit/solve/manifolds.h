#pragma once
// Manifolds on which Ceres varies planes and points. Private to the room.

#include <ceres/manifold.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "fit/model/parameters.h"

namespace culet {

inline double* data(Vec3& v) {
    return &v.x;
}

// A facet's plane (normal and offset, four numbers). Exact symmetry may leave it fewer than three
// directions.
class PlaneManifold : public ceres::Manifold {
public:
    PlaneManifold(int tilts, const Vec3& outward) : tilts_(tilts), outward_(outward) {}
    int AmbientSize() const override { return 4; }
    int TangentSize() const override { return tilts_ + 1; }

    bool Plus(const double* x, const double* delta, double* moved) const override {
        const Vec3 n{x[0], x[1], x[2]};
        const auto along = tilt_directions(n, tilts_, outward_);
        Vec3 to = n;
        for (int k = 0; k < tilts_; ++k) to += delta[k] * along[std::size_t(k)];
        if (tilts_ > 0) to = glm::normalize(to);
        std::copy_n(data(to), 3, moved);
        moved[3] = x[3] + delta[tilts_];
        return true;
    }
    bool PlusJacobian(const double* x, double* jacobian) const override {
        const auto along = tilt_directions({x[0], x[1], x[2]}, tilts_, outward_);
        std::fill_n(jacobian, 4 * TangentSize(), 0.0);
        for (int k = 0; k < tilts_; ++k) {
            for (int i = 0; i < 3; ++i) jacobian[i * TangentSize() + k] = along[std::size_t(k)][i];
        }
        jacobian[3 * TangentSize() + tilts_] = 1;
        return true;
    }
    // Least squares does not need these.
    bool Minus(const double*, const double*, double*) const override { return false; }
    bool MinusJacobian(const double*, double*) const override { return false; }

private:
    int tilts_;
    Vec3 outward_;
};

// A point that an exact symmetry keeps on its axis or in a mirror plane.
class PointManifold : public ceres::Manifold {
public:
    explicit PointManifold(const Parameters::Slots& slots) : slots_(slots) {}
    int AmbientSize() const override { return 3; }
    int TangentSize() const override { return slots_.count; }

    bool Plus(const double* x, const double* delta, double* moved) const override {
        Vec3 to{x[0], x[1], x[2]};
        for (int k = 0; k < slots_.count; ++k) to += delta[k] * slots_.along[std::size_t(k)];
        std::copy_n(data(to), 3, moved);
        return true;
    }
    bool PlusJacobian(const double*, double* jacobian) const override {
        for (int k = 0; k < slots_.count; ++k) {
            for (int i = 0; i < 3; ++i)
                jacobian[i * slots_.count + k] = slots_.along[std::size_t(k)][i];
        }
        return true;
    }
    bool Minus(const double*, const double*, double*) const override { return false; }
    bool MinusJacobian(const double*, double*) const override { return false; }

private:
    Parameters::Slots slots_;
};

}  // namespace culet
