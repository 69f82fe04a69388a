#pragma once
// The equations of one fit: what readings, meets, symmetry and the prior say of the unknowns.

#include <memory>
#include <optional>
#include <vector>

#include "fit/model/fit_model.h"
#include "fit/model/residuals.h"
#include "fit/readings/replicates.h"

namespace culet {

/// formula = value, within sigma or exactly. In the scale of the fit (half diameter 1).
struct Equation {
    enum class Role {
        reading,
        relation,     ///< of symmetry, parallel and coplanar readings
        incidence,    ///< a plane passes through a meet
        released,     ///< likewise, held only so far that the meet has a place at all
        expected,     ///< the prior of the facets (prior.h)
        known_planes  ///< what outlines or a photograph tell of the planes
    };
    Role role = Role::reading;
    int reading = -1;  ///< index, or -1
    int incidence = -1;
    int group = -1;  ///< of estimated uncertainty, or -1
    bool exact = false;
    double value = 0, sigma = 1;
    double size = 1;  ///< of the quantity, by which early stages soften it
    /// What the reading may as well mean: of a nearly upright facet an inclination does not say
    /// whether it leans in or out.
    std::optional<double> other_value;
    /// A length |x|, with a kink at zero that an early stage rounds off.
    bool has_kink = false;
    /// Of a caliper: the corners that its jaws touch, the upper one first, along this direction.
    std::array<Corner, 2> touched{};
    Vec3 caliper{0, 0, 0};
    /// Of readings of one quantity, which share this equation: its value is their mean.
    std::vector<Replicate> replicates;
    double scatter = 0;  ///< about the mean, in sigmas squared
    Formula formula;

    int readings() const { return replicates.empty() ? 1 : static_cast<int>(replicates.size()); }
    /// Takes part in chi-square and in the count of redundancy.
    bool is_counted() const { return !exact && role != Role::released; }
};

/// All equations but hinges, for the corners that carry them at this shape.
std::vector<Equation> all_equations(const FitModel& model, const Shape& shape,
                                    const std::shared_ptr<const Outline>& outline);

/// Of these, what readings, the prior and known planes say; `reduced`: but for symmetry that the
/// parameters take care of. `meets_hold`: corners lie on their planes, so that the line in which
/// two planes cross is the edge, with its direction. On a rough shape that line says nothing.
std::vector<Equation> reading_equations(const FitModel& model, const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline,
                                        bool reduced = false, bool meets_hold = true);

/// Readings of one quantity that share an equation at this shape.
struct MergedReadings {
    std::vector<std::optional<Replicates>> replicates;  ///< with the first of each group
    std::vector<bool> is_merged;                        ///< into the first
};
MergedReadings merged_readings(const FitModel& model, const Shape& shape);

/// Parts of those: of one reading of symmetry, of parallel or of coplanar facets; the prior; what
/// outlines and photographs tell of the planes. `base` carries the reading's index and sigma.
std::vector<Equation> relation_equations(const FitModel& model, const Shape& shape,
                                         const Equation& base);
std::vector<Equation> prior_equations(const PriorModel& prior);
std::vector<Equation> known_plane_equations(
    const std::vector<std::shared_ptr<const KnownPlanes>>& all_known);

/// Those that the jaws of a width, a depth or a table's width may touch.
std::vector<Corner> corners_between_jaws(const FitModel& model, const Reading& reading,
                                         const Outline& outline);

}  // namespace culet
