#include "page/fit_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "page/fit_fields.h"
#include "page/fit_page.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/reading_words.h"

namespace culet {

namespace {

using Json = nlohmann::json;

const Json* with_id(const Json& list, const std::string& id) {
    for (const Json& one : list) {
        if (text_at(one, "id") == id) return &one;
    }
    return nullptr;
}

std::string remedy_for(const Json* proposal, const std::string& unit) {
    if (proposal == nullptr) return "Read it again.";
    if (!text_at(*proposal, "slip").empty()) {
        return fmt::format("If that is the slip, write {} in its place; otherwise read it again.",
                           as_read(number_at(*proposal, "corrected"), unit));
    }
    std::string others;
    for (const Json& id : array_at(*proposal, "alternatives")) {
        if (id.is_string()) others += (others.empty() ? "" : ", ") + id.get<std::string>();
    }
    return others.empty() ? "Read it again."
                          : "Read it again; if it stands, the slip may be in " + others + ".";
}

/// A suspect that no line of the first check mentions.
std::string suspect_words(const Json& reading, const Json* proposal, const std::string& unit) {
    std::string text = text_at(reading, "id") + ": " + reading_words(reading);
    const auto value = number_at(reading, "value");
    if (!value) return text + " conflicts with the others";
    text += " was read as " + as_read(value, unit);
    if (proposal != nullptr) {
        const auto estimate = number_at(*proposal, "estimate");
        const auto sigma = number_at(*proposal, "sigma");
        text += ", the others say " + quantity(estimate, sigma, unit);
        if (estimate) {
            text +=
                fmt::format(": {} away", to_place_of(std::abs(*value - *estimate), sigma, unit));
        }
        if (const std::string slip = text_at(*proposal, "slip"); !slip.empty()) {
            text +=
                fmt::format("; {}? ({})", as_read(number_at(*proposal, "corrected"), unit), slip);
        }
    } else if (const auto off = number_at(reading, "normalized")) {
        text +=
            fmt::format(", {} times its ± from what the others say", decimals(std::abs(*off), 1));
    }
    return text;
}

std::vector<std::string> texts_at(const Json& fit, const char* key) {
    std::vector<std::string> texts;
    for (const Json& one : array_at(fit, key)) {
        if (one.is_string()) texts.push_back(one.get<std::string>());
    }
    return texts;
}

struct Verdict {
    std::string word;
    const char *style, *symbol;
    std::vector<std::string> sentences;  ///< not escaped
};

Verdict contradiction(const Json& fit) {
    const std::vector<SuspectLine> suspects = suspect_lines(fit);
    Verdict verdict{"The readings contradict each other", "bad", "!", {}};
    if (suspects.empty()) {
        const auto apart = texts_at(fit, "disagreeing");
        verdict.sentences = {apart.empty()
                                 ? as_sentence(text_at(fit, "message"))
                                 : fmt::format("{} readings conflict: see below.", apart.size())};
        return verdict;
    }
    verdict.word = suspects.size() == 1
                       ? "One reading contradicts the others"
                       : fmt::format("{} readings contradict the others", suspects.size());
    verdict.sentences.push_back(suspects.front().what + ".");
    if (suspects.size() > 1) verdict.sentences.push_back("The others are listed below.");
    // After its doubts the fit says whether the other readings agree.
    const auto doubts = texts_at(fit, "doubts"), summary = texts_at(fit, "summary");
    if (!doubts.empty() && summary.size() > doubts.size()) {
        verdict.sentences.push_back(summary[doubts.size()]);
    }
    return verdict;
}

Verdict agreement(const Json& fit) {
    Verdict verdict{"The stone agrees with the readings", "good", "✓", {}};
    const auto tiers = tier_sentences(fit);
    if (tiers.empty()) {
        if (!array_at(fit, "readings").empty()) verdict.sentences = {"No reading is in doubt."};
        return verdict;
    }
    verdict.sentences.push_back(tiers.front());
    if (tiers.size() > 1) {
        verdict.sentences.push_back(fmt::format("{} more {} below.", tiers.size() - 1,
                                                tiers.size() == 2 ? "finding is" : "findings are"));
    }
    return verdict;
}

Verdict verdict_of(const Json& fit) {
    const std::string status = text_at(fit, "status");
    if (status == "converged") return agreement(fit);
    if (status == "contradictory") return contradiction(fit);
    if (status == "undetermined") {
        return {"The readings leave parts of the stone open",
                "fair",
                "?",
                {as_sentence(text_at(fit, "message"))}};
    }
    if (status == "not_converged") {
        return {"Do not rely on this stone", "bad", "✕", {as_sentence(text_at(fit, "message"))}};
    }
    return {"The report does not say how the fit ended", "poor", "?", {}};
}

}  // namespace

std::vector<SuspectLine> suspect_lines(const Json& fit) {
    std::vector<SuspectLine> lines;
    const auto doubts = texts_at(fit, "doubts"), suspects = texts_at(fit, "suspects");
    const Json &readings = array_at(fit, "readings"), &proposals = array_at(fit, "proposals");
    std::vector<std::string> doubted, others;
    for (const std::string& id : suspects) {
        const Json* reading = with_id(readings, id);
        const bool out = reading != nullptr && !text_at(*reading, "left_out").empty();
        (out && !doubts.empty() ? doubted : others).push_back(id);
    }
    for (std::size_t i = 0; i < doubts.size(); ++i) {
        // A doubted row may hold several readings, and then the two lists do not correspond.
        const Json* proposal =
            doubted.size() == doubts.size() ? with_id(proposals, doubted[i]) : nullptr;
        const Json* reading =
            doubted.size() == doubts.size() ? with_id(readings, doubted[i]) : nullptr;
        const std::string unit =
            reading_unit(reading == nullptr ? "" : text_at(*reading, "kind"), text_at(fit, "unit"));
        lines.push_back(
            {typeset(doubts[i]), "It is left out of the fit. " + remedy_for(proposal, unit)});
    }
    for (const std::string& id : others) {
        const Json* reading = with_id(readings, id);
        const Json* proposal = with_id(proposals, id);
        if (reading == nullptr) {
            lines.push_back({id, "Read it again."});
            continue;
        }
        const std::string unit = reading_unit(text_at(*reading, "kind"), text_at(fit, "unit"));
        lines.push_back({suspect_words(*reading, proposal, unit),
                         (text_at(*reading, "left_out").empty() ? "The fit still takes it in. "
                                                                : "It is left out of the fit. ") +
                             remedy_for(proposal, unit)});
    }
    return lines;
}

std::vector<std::string> tier_sentences(const Json& fit) {
    std::vector<std::string> sentences;
    for (const Json& tier : array_at(fit, "tier_angles")) {
        for (const std::string& what : texts_at(tier, "what")) {
            sentences.push_back(as_sentence(typeset(what)));
        }
    }
    return sentences;
}

std::vector<std::string> open_sentences(const Json& fit) {
    std::vector<std::string> words, order, by_facet;
    for (const std::string& one : texts_at(fit, "undetermined_words")) {
        words.push_back(as_sentence(typeset(one)));
    }
    std::map<std::string, std::vector<std::string>> freedoms;
    for (const Json& one : array_at(fit, "undetermined")) {
        const std::string facet = text_at(one, "facet");
        if (facet.empty()) continue;
        if (freedoms[facet].empty()) order.push_back(facet);
        freedoms[facet].push_back(text_at(one, "freedom"));
    }
    for (const std::string& facet : order) {
        by_facet.push_back(
            fmt::format("Nothing measured fixes the {} of {}.", listed(freedoms[facet]), facet));
    }
    // The fit's own words treat equal facets together.
    return words.empty() || (!by_facet.empty() && by_facet.size() < words.size()) ? by_facet
                                                                                  : words;
}

std::string fit_card(const FitView& view) {
    const Json fit = parsed_object<Json>(view.fit_json, "the fit report for the page");
    if (fit.empty()) return {};
    const Verdict verdict = verdict_of(fit);
    std::string text;
    for (const std::string& sentence : verdict.sentences) {
        if (!sentence.empty()) text += (text.empty() ? "" : " ") + typeset(sentence);
    }
    return verdict_card(verdict.style, verdict.symbol, verdict.word, text);
}

}  // namespace culet
