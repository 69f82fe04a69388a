// What the reader of a fit should look at.

#include <algorithm>
#include <nlohmann/json.hpp>

#include "page/fit_fields.h"
#include "page/fit_page.h"
#include "page/fit_verdict.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/reading_words.h"
#include "page/templates.h"

namespace culet {

namespace {

using Json = nlohmann::json;

std::vector<ListItem> suspects_of_fit(const Json& fit) {
    std::vector<ListItem> items;
    for (const SuspectLine& line : suspect_lines(fit)) items.push_back({line.what, line.remedy});
    return items;
}

// Only where no single reading explains the contradiction.
std::vector<std::string> disagreeing(const Json& fit) {
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
    return sentences;
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
        // Undetermined edges are common and follow from the sigmas; contradictions with the
        // readings are news.
        if (text_at(finding, "kind").ends_with("_vanishes")) add(text_at(finding, "what"));
    }
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
    std::vector<View> parts;
    const auto add_items = [&](const char* heading, const std::vector<ListItem>& items) {
        if (items.empty()) return;
        parts.push_back({{"heading", heading}, {"list_html", short_list(items)}});
    };
    const auto add = [&](const char* heading, const std::vector<std::string>& sentences) {
        std::vector<ListItem> items;
        for (const std::string& sentence : sentences) items.push_back({"", sentence});
        add_items(heading, items);
    };
    add_items("Suspect readings", suspects_of_fit(fit));
    add("Conflicting readings: one is wrong, or its ± is too small", disagreeing(fit));
    const bool suspected = !parts.empty();
    add("What stands out", tier_sentences(fit));
    add("Where mesh and readings disagree", denied(fit));
    add("Left open by the readings", open_sentences(fit));
    add("What to read next", next_readings(fit));
    if (parts.empty()) return {};
    return filled(templates::fit_look, {{"suspected", suspected}, {"parts", parts}});
}

}  // namespace culet
