#pragma once
// Where the fit may begin, in the order of trust. The start decides everything: those built from
// who meets whom do not care how badly the mesh was made.

#include <optional>
#include <string>
#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

struct Start {
    std::string name;  ///< for reports: "mesh", "canonical", ...
    Shape shape;
    /// The first stage leaves normals as they are: the start trusts the angles that were read.
    bool keep_normals_at_first = false;
    bool is_convex = false;  ///< planar facets that nothing stands above
    /// Which way each facet looks before readings come in: 1 up, -1 down, 0 as the shape says. An
    /// inclination has two meanings; a mesh that is not too rough tells which.
    std::vector<int> sides;
};

/// Turns facets that look the other way than `sides`.
Shape looking_as(const FitModel& model, Shape shape, const std::vector<int>& sides);

/// Makes starts one after another, each when it is asked for; always the same ones.
class Starts {
public:
    explicit Starts(const FitModel& model);
    /// Nothing when there are no more.
    std::optional<Start> next();
    /// Planar and convex but for a small part: then the first starts should do.
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
