#include "page/study_sections.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "page/html.h"
#include "page/parts.h"

namespace culet {

using Json = nlohmann::json;

std::string chart_figure(const std::string& svg) {
    if (svg.empty()) return {};
    return "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Chart\"><figure "
           "class=\"chart-figure\">" +
           svg + "</figure></div>\n";
}

std::string study_provenance(const Json& study, const std::string& version,
                             const std::string& command) {
    std::string rows;
    const auto row = [&](const std::string& name, const std::string& value) {
        if (value.empty()) return;
        rows += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"path\">{}</td></tr>\n",
                            escaped(name), escaped(value));
    };
    row("program", version.empty() ? "" : "culet " + version);
    row("command", command);
    if (study.contains("options") && study["options"].is_object()) {
        for (const auto& [key, value] : study["options"].items()) {
            row(key, value.is_string() ? value.get<std::string>() : value.dump());
        }
    }
    return section(
        "provenance", "How this page was made",
        table("Made from", "<th scope=\"col\">What</th><th scope=\"col\">Which</th>", rows));
}

}  // namespace culet
