#include "page/study_sections.h"

#include <nlohmann/json.hpp>

#include "page/parts.h"
#include "page/templates.h"

namespace culet {

using Json = nlohmann::json;

std::string chart_figure(const std::string& svg) {
    return filled(templates::chart_figure, {{"chart_svg", svg}});
}

std::string study_provenance(const Json& study, const std::string& version,
                             const std::string& command) {
    std::vector<View> rows;
    const auto row = [&](const std::string& name, const std::string& value) {
        if (!value.empty()) rows.push_back({{"name", name}, {"value", value}});
    };
    row("program", version.empty() ? "" : "culet " + version);
    row("command", command);
    if (study.contains("options") && study["options"].is_object()) {
        for (const auto& [key, value] : study["options"].items()) {
            row(key, value.is_string() ? value.get<std::string>() : value.dump());
        }
    }
    return filled(templates::study_provenance, {{"tall", is_tall(rows)}, {"rows", rows}});
}

}  // namespace culet
