// The top of the report: the verdict, and the numbers that a reader asks for first.

#include <fmt/format.h>

#include "compare/report/report_parts.h"
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

std::string comparison_tiles(const Comparison& c) {
    std::string tiles;
    if (c.meaning && c.meaning->equivalent.deg) {
        const EquivalentError& error = c.meaning->equivalent;
        tiles += tile("Equivalent facet error",
                      (error.at_least  ? "≥ "
                       : error.at_most ? "≤ "
                                       : "") +
                          significant(error.deg, 2) + "°",
                      fmt::format("{}° to {}°", significant(error.low_deg, 2),
                                  significant(error.high_deg, 2)));
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

// What the page's reader must know before believing the verdict.
const char* const k_what_it_means =
    "The chance level is the same render, turned and mirrored in the picture's plane: what outline "
    "and overall brightness reach without any agreement of the pattern. The verdict compares the "
    "pattern of light with that level only. It does not tell this stone from another of the same "
    "cut, and its limits are proposals that have not been validated.";

const char* const k_what_is_calibrated =
    "The equivalent facet error is that of simulated photographs of this stone, in this pose and "
    "light, which score like this photograph. It knows of facets, camera noise and registration; "
    "dust, inclusions, another tone curve or a light that is not quite the scene's count as facet "
    "error too.";

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
    std::string body =
        fmt::format("<header class=\"headline\"><h1>{}</h1>\n", escaped(report.title));
    if (report.comparison) {
        const Comparison& c = *report.comparison;
        const VerdictShown shown_verdict = verdict_shown(c.verdict);
        if (c.simulated) {
            body +=
                "<p class=\"simulated\"><b>Simulated photograph.</b> The photograph on this "
                "page was computed, not taken with a camera.</p>\n";
        }
        if (c.geometry_only) {
            body +=
                "<p class=\"simulated\"><b>Geometry only.</b> This photograph cannot serve for "
                "photometry: scores of brightness and colour are left out, and the verdict rests "
                "on "
                "shapes and places.</p>\n";
        }
        body += verdict_card(shown_verdict.style, shown_verdict.symbol, shown_verdict.word,
                             as_sentence(c.reason));
    }
    body += fit_card(fitted);
    std::string tiles;
    if (report.comparison) tiles += comparison_tiles(*report.comparison);
    tiles += fit_tiles(fitted);
    if (!tiles.empty()) body += "<dl class=\"tiles\">" + tiles + "</dl>\n";
    if (report.comparison && report.comparison->usable()) {
        body += fmt::format("<p class=\"meaning\">{}</p>\n",
                            report.comparison->meaning ? k_what_is_calibrated : k_what_it_means);
    }
    return body + "</header>\n";
}

}  // namespace culet
