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

/// Those of stone/design/cut_measures.h, volume and weight. The sigma of an extreme or of a
/// variation is that of the facets where it lies: where others come near, it may lie there as well.
std::vector<CutQuantity> cut_quantities(const FitModel& model, const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline);

}  // namespace culet
