// Top of the report: the verdict and the most important numbers.

#include <fmt/format.h>

#include "compare/report/report_parts.h"
#include "compare/templates.h"
#include "page/html.h"
#include "page/parts.h"

namespace culet {

namespace {

const Score* score_of(const Comparison& comparison, const char* key) {
    for (const Score& score : comparison.scores) {
        if (score.key == key) return &score;
    }
    return nullptr;
}

std::string comparison_tiles(const Comparison& c,
                             const std::optional<CalibratedVerdict>& calibrated) {
    std::string tiles;
    if (calibrated && calibrated->equivalent.deg) {
        const EquivalentError& error = calibrated->equivalent;
        tiles += tile("As good as facets off by",
                      (error.at_least  ? "≥ "
                       : error.at_most ? "≤ "
                                       : "") +
                          significant(error.deg, 2) + "°",
                      fmt::format("{}° to {}° (equivalent facet error)",
                                  significant(error.low_deg, 2), significant(error.high_deg, 2)));
    }
    if (const Score* zncc = score_of(c, "zncc"); zncc != nullptr) {
        tiles += tile("Pattern of light", decimals(zncc->value, 3),
                      fmt::format("1 is perfect; chance {} ± {}", decimals(zncc->null_mean, 2),
                                  decimals(zncc->null_sd, 2)));
    }
    if (const Score* delta = score_of(c, "deltaE00_mean"); delta != nullptr) {
        tiles += tile("Colour difference", decimals(delta->value, 1),
                      fmt::format("mean ΔE00; chance {} ± {}", decimals(delta->null_mean, 1),
                                  decimals(delta->null_sd, 1)));
    }
    if (c.reflexes.in_photo > 0) {
        tiles +=
            tile("Reflexes found", fmt::format("{} of {}", c.reflexes.matched, c.reflexes.in_photo),
                 c.reflexes.displacement ? fmt::format("{} % of the diameter apart",
                                                       decimals(100 * *c.reflexes.displacement, 1))
                                         : "");
    }
    if (c.registration.iou > 0) {
        tiles += tile("Outlines overlap", decimals(c.registration.iou, 4),
                      fmt::format("{} px apart", decimals(c.registration.residual_px, 2)));
    }
    if (!c.scores.empty()) {
        tiles += tile("Gain R G B",
                      significant(c.gain[0], 2) + " · " + significant(c.gain[1], 2) + " · " +
                          significant(c.gain[2], 2),
                      "factors on the render");
    }
    return tiles;
}

}  // namespace

VerdictShown verdict_shown(Verdict verdict) {
    switch (verdict) {
        case Verdict::match:
            return {"Match", "good", "✓"};
        case Verdict::partial:
            return {"Partial match", "fair", "≈"};
        case Verdict::no_evidence:
            return {"No evidence of a match", "poor", "?"};
        case Verdict::refused:
            return {"Comparison refused", "bad", "✕"};
    }
    return {"", "", ""};
}

std::string headline_section(const Report& report, const FitView& fitted) {
    const Comparison* c = report.comparison ? &*report.comparison : nullptr;
    std::string verdict;
    if (c != nullptr) {
        const VerdictShown shown = verdict_shown(c->verdict);
        verdict = verdict_card(shown.style, shown.symbol, shown.word, as_sentence(c->reason));
    }
    const bool scored = c != nullptr && c->usable();
    return filled(
        templates::report_headline,
        {{"title", report.title},
         {"simulated", c != nullptr && c->simulated},
         {"geometry_only", c != nullptr && c->geometry_only},
         {"verdict_html", verdict},
         {"fit_html", fit_card(fitted)},
         {"tiles_html", (c != nullptr ? comparison_tiles(*c, report.calibrated) : std::string()) +
                            fit_tiles(fitted)},
         {"certificate", report.certificate},
         {"uncalibrated", scored && !report.calibrated},
         {"calibrated", scored && report.calibrated.has_value()}});
}

}  // namespace culet
