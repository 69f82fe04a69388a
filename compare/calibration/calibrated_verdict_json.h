#pragma once
// Private to the folder, because it exposes nlohmann's types.

#include <nlohmann/json_fwd.hpp>

#include "compare/calibration/calibrated_verdict.h"

namespace culet {

/// "equivalent_facet_error"; degrees.
nlohmann::ordered_json equivalent_json(const EquivalentError& error);
/// "meaning": headline, equivalent facet error, nulls, hypotheses.
nlohmann::ordered_json calibrated_verdict_json(const CalibratedVerdict& verdict);
/// "sensitivity": for each facet error, the mean, spread and fitted curve of every score.
nlohmann::ordered_json sensitivity_json(const CalibratedVerdict& verdict);

}  // namespace culet
