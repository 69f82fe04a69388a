#pragma once
// What scores mean, for programs. Private to the room: shows nlohmann's JSON.

#include <nlohmann/json_fwd.hpp>

#include "compare/calibration/meaning.h"

namespace culet {

/// "meaning": headline, equivalent facet error, nulls, hypotheses.
nlohmann::ordered_json meaning_json(const Meaning& meaning, const Calibration& calibration);
/// "sensitivity": one row a facet error, with mean, spread and fitted curve of every score.
nlohmann::ordered_json sensitivity_json(const Meaning& meaning);

}  // namespace culet
