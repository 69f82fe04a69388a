#pragma once
// Readings in the words of the bench. Private to the folder: shows JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace culet {

/// "A, B and C".
std::string listed(const std::vector<std::string>& names);

/// The unit of readings of this kind: "deg", "ct", "mm3", or `length_unit`.
std::string reading_unit(const std::string& kind, const std::string& length_unit);

/// "inclination of C5", "angle between P5 and P4", "width at 45°". Not escaped.
std::string reading_words(const nlohmann::json& reading);

/// One of the report's `help`: "Read the azimuth (the index) of G29: ...". Empty if it is not worth
/// the work. Not escaped.
std::string next_reading_words(const nlohmann::json& help);

}  // namespace culet
