#pragma once
// The equations of one fit: what readings, meets, symmetry and the prior say of the unknowns.

#include <memory>
#include <optional>
#include <vector>

#include "fit/model/fit_model.h"
#include "fit/model/residuals.h"
#include "fit/readings/replicates.h"

namespace culet {

/// formula = value, within sigma or exactly. Half diameters and radians.
struct Equation {
    enum class Role {
        reading,
        relation,      ///< of symmetry, parallel and coplanar readings
        incidence,     ///< a plane passes through a meet
        released,      ///< the same, held only so that the meet's point has a position
        expected,      ///< the prior of the facets (prior.h)
        known_planes,  ///< what outlines or a photograph tell of the planes
        placed         ///< holds the motion of lines (line_views.h) where nothing tells it
    };
    Role role = Role::reading;
    int reading = -1;  ///< index, or -1
    int incidence = -1;
    int group = -1;  ///< group whose sigma is estimated, or -1
    bool exact = false;
    double value = 0, sigma = 1;
    /// The value on the other branch: an inclination does not say whether a nearly upright facet
    /// leans in or out.
    std::optional<double> other_value;
    /// A length |x|, whose kink at zero early stages smooth.
    bool has_kink = false;
    /// For a caliper: its direction and the corners that its jaws touch, the upper one first.
    std::array<Corner, 2> touched{};
    Vec3 caliper{0, 0, 0};
    /// Readings of one quantity that share this equation. The value is their mean.
    std::vector<Replicate> replicates;
    double scatter = 0;  ///< chi-square of the replicates about their mean
    Formula formula;

    int readings() const { return replicates.empty() ? 1 : static_cast<int>(replicates.size()); }
    /// Counts in chi-square and in the redundancy.
    bool is_counted() const { return !exact && role != Role::released && role != Role::placed; }
};

/// All equations except hinges, for the corners that carry them at this shape.
std::vector<Equation> all_equations(const FitModel& model, const Shape& shape,
                                    const std::shared_ptr<const Outline>& outline);

/// Those of the readings, the prior and the known planes. `reduced`: without symmetry that the
/// parameters keep. `meets_hold`: corners lie on their planes, so that the crossing line of two
/// planes is their edge; on a rough shape it is not.
std::vector<Equation> reading_equations(const FitModel& model, const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline,
                                        bool reduced = false, bool meets_hold = true);

/// Readings of one quantity that share an equation at this shape.
struct MergedReadings {
    std::vector<std::optional<Replicates>> replicates;  ///< with the first of each group
    std::vector<bool> is_merged;                        ///< into the first one
};
MergedReadings merged_readings(const FitModel& model, const Shape& shape);

/// Parts of these: one symmetry, parallel or coplanar reading; one line; the prior; the motions of
/// lines; the planes known from outlines and photographs. `base` carries the reading's index and
/// sigma.
std::vector<Equation> relation_equations(const FitModel& model, const Shape& shape,
                                         const Equation& base);
std::vector<Equation> line_equations(const LineView& view, const Equation& base);
std::vector<Equation> prior_equations(const PriorModel& prior);
std::vector<Equation> motion_equations(const LineViews& lines);
std::vector<Equation> known_plane_equations(
    const std::vector<std::shared_ptr<const KnownPlanes>>& all_known);

/// The corners that the jaws of a width, a depth or a table's width may touch.
std::vector<Corner> corners_between_jaws(const FitModel& model, const Reading& reading,
                                         const Outline& outline);

}  // namespace culet
