#pragma once
// A comparison as JSON.

#include <optional>
#include <string>

#include "compare/calibration/calibrated_verdict.h"
#include "compare/scores/compare.h"

namespace culet {

/// Origin of the compared data.
struct CompareSources {
    std::string photo_file, render_file, mask_file;
    std::string pose{};  ///< JSON of the found pose; empty: none was searched
};

/// The scores as one JSON object (schema 1).
std::string scores_json(const Comparison& comparison, const CompareSources& sources = {},
                        const std::optional<CalibratedVerdict>& calibrated = {});

}  // namespace culet
