#pragma once
// Starts of the fit, in the order of trust. The start decides which minimum is found. Starts built
// from the topology do not depend on how badly the mesh was drawn.

#include <optional>
#include <string>
#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

struct Start {
    std::string name;  ///< for reports: "mesh", "canonical", ...
    Shape shape;
    /// The first stage keeps the normals, because the start trusts the angles read.
    bool keep_normals_at_first = false;
    bool is_convex = false;  ///< planar facets, and no corner above them
    /// Which way each facet looks before readings are used: 1 up, -1 down, 0 as the shape shows. An
    /// inclination leaves the side open; a mesh that is not too rough tells it.
    std::vector<int> sides;
};

/// Turns facets that look the other way from `sides`.
Shape looking_as(const FitModel& model, Shape shape, const std::vector<int>& sides);

/// Makes starts one after another on demand, always in the same order.
class Starts {
public:
    explicit Starts(const FitModel& model);
    std::optional<Start> next();
    /// The mesh is nearly planar and convex: the first starts should suffice.
    bool mesh_is_good() const { return mesh_is_good_; }

private:
    void make_canonical();
    Start mesh() const;
    std::optional<Start> similar();
    std::optional<Start> affine();
    std::optional<Start> from_angles(std::optional<Start> base, const std::string& name) const;
    Start over_mesh(const std::string& name, Shape shape) const;
    Shape upright(Shape shape) const;
    void find_sides();

    const FitModel& model_;
    bool mesh_is_good_ = false, canonical_made_ = false;
    std::optional<Shape> canonical_;
    std::vector<int> sides_;
    int at_ = 0;
};

}  // namespace culet
