#pragma once
// How far the corners of a hand-made mesh lie off the planes of their facets, and so how surely it
// says which way a facet faces. In half diameters and radians. Private to the room.

#include <optional>
#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

class MeshRoughness {
public:
    /// Nothing when no facet has more than three corners: none of them shows that it is off.
    static std::optional<MeshRoughness> of(const FitModel& model);

    /// Of a corner, across its facet: the root of the mean square over all corners beyond three of
    /// each facet.
    double corner() const { return corner_; }
    /// Of a facet's inclination alone, by its corners' errors and how far they reach up and down:
    /// slender facets are told well along, badly across. Infinite where its corners are all in
    /// line.
    double tilt(int facet) const;

private:
    MeshRoughness(const FitModel& model, double corner) : model_(&model), corner_(corner) {}
    std::vector<Vec3> from_middle(int facet) const;
    const FitModel* model_;
    double corner_;
};

}  // namespace culet
