#pragma once
// A calibrated verdict as JSON. Private to the folder, because it exposes nlohmann's types.

#include <nlohmann/json_fwd.hpp>

#include "compare/calibration/calibrated_verdict.h"

namespace culet {

/// "meaning": headline, equivalent facet error, nulls, hypotheses.
nlohmann::ordered_json calibrated_verdict_json(const CalibratedVerdict& verdict);
/// "sensitivity": one row for each facet error, with mean, spread and fitted curve of every score.
nlohmann::ordered_json sensitivity_json(const CalibratedVerdict& verdict);

}  // namespace culet
