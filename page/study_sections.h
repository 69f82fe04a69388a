#pragma once
// Parts of the pages of fit and scene studies. Each returns HTML.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace culet {

/// Scrolls on narrow screens; empty for an empty chart.
std::string chart_figure(const std::string& svg);

std::string study_provenance(const nlohmann::json& study, const std::string& version,
                             const std::string& command);

}  // namespace culet
