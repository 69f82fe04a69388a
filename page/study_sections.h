#pragma once
// Parts of the pages of fit and scene studies. Each returns HTML.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace culet {

/// A chart that scrolls on narrow screens; empty for an empty one.
std::string chart_figure(const std::string& svg);

/// The program, the command and the study's `options`.
std::string study_provenance(const nlohmann::json& study, const std::string& version,
                             const std::string& command);

}  // namespace culet
