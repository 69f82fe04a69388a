#pragma once
// The proportions by which the trade describes a cut, as functions of a fitted shape with their
// derivatives, so that they come with uncertainties.

#include <memory>
#include <string>
#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

struct CutQuantity {
    std::string name, unit;  ///< unit: %, deg, mm3, ct, the stone's length unit, or empty
    Quantity quantity;       ///< in `unit`
};

/// `diameter` is the mean caliper width in plan (perimeter of the outline / pi, Cauchy 1832) of a
/// round stone (stone/solid/caliper.h); of others `width` is the least caliper width and `length`
/// the extent across it. `caliper min`, `caliper max` and `caliper mean` are those over all
/// directions in plan: of a girdle of few flats they lie apart (16 flats: by 2 %), though calipers
/// that were laid on its corners all read the same. Percentages are of the diameter, or of the
/// width. The table of a round stone is twice the mean distance of its corners from their middle,
/// of others its extent along the width. Heights are above and below the mean heights of the
/// girdle's upper and lower edges' corners, so that crown, girdle and pavilion add up to the depth.
/// Crown and pavilion angles are means over the mains (`main_facets`).
std::vector<CutQuantity> cut_quantities(const FitModel& model, const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline);

}  // namespace culet
