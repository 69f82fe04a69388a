#pragma once
// The model of one fit: the mesh in the fit's frame, the readings with their effective sigmas,
// meets, symmetries, the prior and the planes known from outlines.

#include <memory>
#include <utility>
#include <vector>

#include "fit/model/frame.h"
#include "fit/model/known_planes.h"
#include "fit/model/line_views.h"
#include "fit/model/meets.h"
#include "fit/model/options.h"
#include "fit/model/prior.h"
#include "fit/model/symmetries.h"
#include "stone/solid/half_edges.h"

namespace culet {

class FitModel {
public:
    /// Keeps a reference to `stone`. Throws InputError.
    FitModel(const Stone& stone, const std::vector<Reading>& readings, const FitOptions& options);

    const Stone& stone() const { return stone_; }
    const Frame& frame() const { return frame_; }
    const HalfEdges& edges() const { return edges_; }
    /// The mesh at the start, and its corners.
    const Shape& mesh_shape() const { return mesh_shape_; }
    const std::shared_ptr<const Outline>& mesh_outline() const { return mesh_outline_; }
    Layout layout() const { return layout_of(mesh_shape_); }

    /// With their effective sigmas.
    const std::vector<Reading>& readings() const { return readings_; }
    /// Indices of readings of one quantity, which share an equation.
    const std::vector<std::vector<int>>& replicated() const { return replicated_; }
    const Meets& meets() const { return meets_; }
    const Symmetries& symmetries() const { return symmetries_; }
    const LineViews& lines() const { return lines_; }
    const PriorModel& prior() const { return prior_; }
    const std::vector<std::shared_ptr<const KnownPlanes>>& known_planes() const {
        return known_planes_;
    }
    bool has_outlines() const { return has_outlines_; }

    Parameters parameters() const { return symmetries_.parameters(mesh_shape_, frame_.up_facet()); }

    void set_group_sigmas(const std::array<double, 2>& sigmas) { meets_.group_sigmas = sigmas; }
    /// Changes a reading's sigma, in its unit (robust weights).
    void set_reading_sigma(int reading, double sigma) {
        readings_[std::size_t(reading)].sigma = sigma;
    }
    /// Gives every reading an equation of its own from now on.
    void keep_replicates_apart() { replicated_.clear(); }

private:
    const Stone& stone_;
    Frame frame_;
    HalfEdges edges_;
    Shape mesh_shape_;
    std::shared_ptr<const Outline> mesh_outline_;
    std::vector<Reading> readings_;
    std::vector<std::vector<int>> replicated_;
    Meets meets_;
    std::vector<std::shared_ptr<const KnownPlanes>> known_planes_;
    Symmetries symmetries_;
    LineViews lines_;
    PriorModel prior_;
    bool has_outlines_ = false;
};

}  // namespace culet
