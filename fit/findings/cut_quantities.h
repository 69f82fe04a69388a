#pragma once
// The proportions by which the trade describes a cut, as functions of a fitted shape, with
// derivatives for their uncertainties.

#include <memory>
#include <string>
#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

struct CutQuantity {
    std::string name, unit;  ///< unit: %, deg, mm3, ct, the stone's length unit, or empty
    Quantity quantity;       ///< in `unit`
};

/// - `diameter` of a round stone: mean caliper width in plan (perimeter / pi, Cauchy 1832;
///   stone/solid/caliper.h).
/// - `width`, `length`: the smallest caliper width and the extent across it.
/// - `caliper min`, `max`, `mean`: over all directions in plan. They differ for a girdle of few
///   flats (16 flats: by 2 %), though calipers laid on its corners all read the same.
/// - Table of a round stone: twice the mean distance of its corners from their middle; else its
///   extent along the width.
/// - Heights count from the mean heights of the corners of the girdle's edges, so crown, girdle and
///   pavilion add up to the depth.
/// - Crown and pavilion angles: means over the mains (`main_facets`).
/// Percentages are of a round stone's diameter, else of the width.
std::vector<CutQuantity> cut_quantities(const FitModel& model, const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline);

}  // namespace culet
