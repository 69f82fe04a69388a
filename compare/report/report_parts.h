#pragma once
// The report page's sections: HTML, or nothing without their data.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/report/report.h"
#include "page/colour_maps.h"
#include "page/fit_page.h"

namespace culet {

/// The linear value that exposes the stone well. `brightest`: each pixel's largest channel. Nothing
/// without light.
std::optional<double> white_for_stone(std::vector<float> brightest);
/// For both pictures, at most the photograph's own.
double white_shown(const Comparison& comparison);

/// PNG data URI of a linear picture, with `white` shown as white.
std::string picture_uri(const Photo& picture, double white);
/// The same for a map; transparent where it has no value.
std::string map_uri(const PixelMap& map, ColourMap colours, double low, double high);

std::string headline_section(const Report& report, const FitView& fitted);
std::string pictures_section(const Report& report);
std::string maps_section(const Report& report);
std::string scores_section(const Report& report, const nlohmann::json& scores);
std::string reflexes_section(const Report& report);
std::string calibration_section(const Report& report);
std::string registration_section(const Report& report);
std::string changes_section(const Report& report);
std::string plan_section(const nlohmann::json& stats);
std::string provenance_section(const Report& report);

struct VerdictShown {
    const char *word, *style, *symbol;
};
VerdictShown verdict_shown(Verdict verdict);

/// "ZNCC, 2 %": a score's name for people.
std::string score_name(const std::string& key);

std::string photo_word(const Report& report);

}  // namespace culet
