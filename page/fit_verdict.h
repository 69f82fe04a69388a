#pragma once
// What the verdict and the list of suspects share. Private to the folder: shows JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace culet {

/// A reading (or row of readings) that contradicts the others, the worst first: file and line or
/// the reading's name, by how much, and the slip that would explain it. Not escaped.
struct SuspectLine {
    std::string what;
    std::string remedy;
};
std::vector<SuspectLine> suspect_lines(const nlohmann::json& fit);

/// Facets that deviate from their tier, one sentence each. Not escaped.
std::vector<std::string> tier_sentences(const nlohmann::json& fit);

/// What the readings do not determine, one sentence each. Not escaped.
std::vector<std::string> open_sentences(const nlohmann::json& fit);

}  // namespace culet
