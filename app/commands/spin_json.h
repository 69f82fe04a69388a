#pragma once
// What `culet spin --json` writes.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "refine/spin/series_light.h"

namespace culet {

/// `width_mm`: 0: lengths are in pixels.
nlohmann::ordered_json spin_json(const std::vector<SpinFrame>& frames, const SpinResult& found,
                                 double width_mm);

/// Adds `light`, and `comparison` if frames were left out.
void add_light(const std::vector<SpinFrame>& frames, const std::string& material,
               const SeriesLight& light, nlohmann::ordered_json& json);

}  // namespace culet
