#pragma once
// How readings change when a part of the stone is cut off. Private to the room: shows Eigen.

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "fit/model/cut_off.h"
#include "fit/model/linear.h"

namespace culet {

class ErrorSignatures {
public:
    using Index = Eigen::Index;
    ErrorSignatures(const System& system, const Shape& shape, const Outline& outline,
                    const Linearised& linear);

    const CornerNet& net() const { return net_; }
    /// The equations that change, in their order. Of a part of what is cut off, no others do.
    std::vector<Index> touched_by(const CutOff& off) const;
    /// By how much, in sigmas; of the equations that change.
    std::vector<std::pair<Index, double>> of(const Plane& plane, const CutOff& off,
                                             const std::vector<Index>& touched) const;

private:
    const Reading& reading_of(Index i) const;
    void list(Index i, const Outline& outline);
    double change_of(Index i, const Plane& plane, const CutOff& off) const;
    Vec3 normal_of(int facet) const;

    const System& system_;
    CornerNet net_;
    const Linearised& linear_;
    std::vector<std::vector<Index>> by_corner_;
    std::vector<Index> volumes_;
};

}  // namespace culet
