// What the reader of a fit should look at: suspects, what stands out, what is open, what to read
// next.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "page/fit_fields.h"
#include "page/fit_page.h"
#include "page/fit_verdict.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/reading_words.h"

namespace culet {

namespace {

using Json = nlohmann::json;

std::string part(const std::string& heading, const std::vector<std::string>& sentences) {
    std::vector<std::string> items;
    for (const std::string& sentence : sentences) items.push_back(escaped(sentence));
    const std::string list = short_list(items);
    return list.empty() ? "" : "<h3>" + heading + "</h3>\n" + list;
}

std::string suspects_part(const Json& fit) {
    std::vector<std::string> items;
    for (const SuspectLine& line : suspect_lines(fit)) {
        items.push_back(fmt::format("<b>{}.</b> {}", escaped(line.what), escaped(line.remedy)));
    }
    const std::string list = short_list(items);
    return list.empty() ? "" : "<h3>Suspect readings</h3>\n" + list;
}

// Only where no single reading explains the contradiction.
std::string disagreeing_part(const Json& fit) {
    std::vector<std::string> sentences;
    if (!array_at(fit, "suspects").empty()) return {};
    for (const Json& id : array_at(fit, "disagreeing")) {
        if (!id.is_string()) continue;
        std::string line = id.get<std::string>();
        for (const Json& reading : array_at(fit, "readings")) {
            if (text_at(reading, "id") != line) continue;
            const std::string unit = reading_unit(text_at(reading, "kind"), text_at(fit, "unit"));
            line += ": " + reading_words(reading);
            if (const auto value = number_at(reading, "value")) {
                line += ", " + quantity(value, number_at(reading, "sigma"), unit);
            }
            break;
        }
        sentences.push_back(line);
    }
    return part("Readings that cannot hold together: one is wrong, or its ± is too small",
                sentences);
}

std::vector<std::string> denied(const Json& fit) {
    std::vector<std::string> sentences;
    const auto add = [&](const Json& text) {
        if (text.is_string()) sentences.push_back(as_sentence(typeset(text.get<std::string>())));
    };
    for (const Json& change : array_at(fit, "changes")) add(change);
    if (const auto meets = fit.find("meets"); meets != fit.end()) {
        for (const Json& advice : array_at(*meets, "proposals")) add(advice);
    }
    for (const Json& finding : array_at(fit, "shape")) {
        // Open edges are common and follow from the sigmas; what the readings deny is news.
        if (text_at(finding, "kind").ends_with("_vanishes")) add(text_at(finding, "what"));
    }
    for (const Json& extra : array_at(fit, "extra_facets")) add(text_at(extra, "what"));
    std::erase(sentences, "");
    return sentences;
}

std::vector<std::string> next_readings(const Json& fit) {
    std::vector<std::string> sentences;
    for (const Json& help : array_at(fit, "help")) {
        const std::string words = next_reading_words(help);
        if (!words.empty()) sentences.push_back(words);
    }
    return sentences;
}

}  // namespace

std::string fit_look_section(const FitView& view) {
    const Json fit = parsed_object<Json>(view.fit_json, "the fit report for the page");
    const std::string suspects = suspects_part(fit) + disagreeing_part(fit);
    const std::string body = suspects + part("What stands out", tier_sentences(fit)) +
                             part("Where mesh and readings disagree", denied(fit)) +
                             part("Left open by the readings", open_sentences(fit)) +
                             part("What to read next", next_readings(fit));
    return section("look", suspects.empty() ? "What was found" : "Look at this first", body);
}

}  // namespace culet
