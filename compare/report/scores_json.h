#pragma once
// A comparison for programs.

#include <optional>
#include <string>

#include "compare/calibration/calibrated_verdict.h"
#include "compare/scores/compare.h"

namespace culet {

/// What a program would want to know beside the scores themselves.
struct CompareSources {
    std::string photo_file, render_file, mask_file;
    std::string pose{};  ///< JSON of the pose that was found; empty: none was looked for
};

/// The scores as one JSON object (schema 1).
std::string scores_json(const Comparison& comparison, const CompareSources& sources = {},
                        const std::optional<CalibratedVerdict>& calibrated = {});

}  // namespace culet
