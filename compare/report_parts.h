#pragma once
// The sections of the report page. Each returns HTML, or nothing when its data is not there.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "compare/colour_maps.h"
#include "compare/report.h"

namespace culet {

/// Throws InputError that names `what` when the text is no JSON object. Empty text: an empty
/// object.
nlohmann::json parsed_object(const std::string& text, const char* what);

std::optional<double> number_at(const nlohmann::json& object, const char* key);
std::string text_at(const nlohmann::json& object, const char* key);

/// `<section id=... >` with its heading; nothing when the body is empty.
std::string section(const std::string& id, const std::string& heading, const std::string& body);

/// `<div class="scroll">` around a table, so that a narrow screen scrolls the table, not the page.
std::string table(const std::string& caption, const std::string& head, const std::string& body);

/// A bar with ticks: from, middle, to.
std::string colour_bar(ColourMap map, const std::string& what, const std::string& from,
                       const std::string& middle, const std::string& to);

/// Two pictures (PNG data URIs of one size) under a slider.
struct SliderSide {
    std::string label, uri, alternative;
};
std::string slider(const std::string& id, const SliderSide& left, const SliderSide& right);

/// PNG data URI of a linear picture, `white` shown as white.
std::string picture_uri(const Photo& picture, double white);

std::string headline_section(const Report& report, const nlohmann::json& scores,
                             const nlohmann::json& fit);
std::string pictures_section(const Report& report);
std::string maps_section(const Report& report);
std::string scores_section(const Report& report, const nlohmann::json& scores);
std::string registration_section(const Report& report);
std::string fit_section(const Report& report, const nlohmann::json& fit);
std::string changes_section(const Report& report);
std::string plan_section(const nlohmann::json& stats);
std::string provenance_section(const Report& report);

/// "photograph", or "simulated photograph" wherever that is what it is.
std::string photo_word(const Report& report);

}  // namespace culet
