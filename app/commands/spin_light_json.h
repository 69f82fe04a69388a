#pragma once
// The light of a series and the comparison of renders in it, as `culet spin --json` writes them.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "refine/spin/series_light.h"

namespace culet {

/// Adds `light`, and `comparison` if frames were left out.
void add_light(const std::vector<SpinFrame>& frames, const std::string& material,
               const SeriesLight& light, nlohmann::ordered_json& json);

}  // namespace culet
