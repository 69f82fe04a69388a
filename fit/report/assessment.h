#pragma once
// The report's part on proportions, proposals and what to measure next. Private to the room.

#include <nlohmann/json_fwd.hpp>

#include "fit/findings/result.h"

namespace culet {

void report_assessment(const FitResult& result, nlohmann::ordered_json& report);

}  // namespace culet
