#pragma once
// How far the corners of a hand-made mesh lie off their facets' planes, and so how reliably it
// shows which way a facet faces. Half diameters and radians. Private to the room.

#include <optional>
#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

class MeshRoughness {
public:
    /// Nothing when all facets are triangles, which show no error.
    static std::optional<MeshRoughness> of(const FitModel& model);

    /// Error of a corner across its facet: root mean square over the corners beyond three of each
    /// facet.
    double corner() const { return corner_; }
    /// Error of a facet's inclination, from its corners' errors and their extent up and down: a
    /// slender facet tilts little along and much across. Infinite where its corners are collinear.
    double tilt(int facet) const;

private:
    MeshRoughness(const FitModel& model, double corner) : model_(&model), corner_(corner) {}
    std::vector<Vec3> from_middle(int facet) const;
    const FitModel* model_;
    double corner_;
};

}  // namespace culet
