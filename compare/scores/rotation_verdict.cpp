#include "compare/scores/rotation_verdict.h"

#include <fmt/format.h>

#include <algorithm>

#include "page/html.h"

namespace culet {

namespace {

// The pattern of light, or, where the photograph's brightness cannot be trusted, the facets' edges.
const Score& deciding(const Comparison& result) {
    const char* key = result.geometry_only ? "cw_ssim" : "zncc";
    return *std::find_if(result.scores.begin(), result.scores.end(),
                         [&](const Score& s) { return s.key == key; });
}

}  // namespace

void judge_by_rotations(Comparison& result) {
    const Score& zncc = deciding(result);
    if (!zncc.value) {
        result.verdict = Verdict::no_evidence;
        result.reason = "there is no pattern to compare: " + zncc.note;
        return;
    }
    if (result.null_draws < 20 || !zncc.z) {
        result.verdict = Verdict::no_evidence;
        result.reason =
            "the render looks much the same however it is turned, so this test cannot tell a match "
            "from chance";
        return;
    }
    const double enough = result.geometry_only ? k_match_cw_ssim : k_match_zncc;
    const std::string what =
        result.geometry_only ? "the facets' images agree" : "bright and dark places agree";
    const double z = *zncc.z;
    const std::string figures = fmt::format(
        "{} {}, chance level {} ± {}", result.geometry_only ? "CW-SSIM" : "correlation",
        decimals(*zncc.value, 2), decimals(zncc.null_mean, 2), decimals(zncc.null_sd, 2));
    if (z >= k_match_z && *zncc.value >= enough) {
        result.verdict = Verdict::match;
        result.reason = fmt::format(
            "{} far better than those of the same "
            "render turned ({})",
            what, figures);
    } else if (z >= k_partial_z && *zncc.p <= 1 / (result.null_draws + 0.99)) {
        result.verdict = Verdict::partial;
        result.reason = fmt::format(
            "{} better than those of the same "
            "render turned, but not by much ({})",
            what, figures);
    } else {
        result.verdict = Verdict::no_evidence;
        result.reason = fmt::format(
            "{} no better than those of the same "
            "render turned ({})",
            what, figures);
    }
}

const char* name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::match:
            return "match";
        case Verdict::partial:
            return "partial";
        case Verdict::no_evidence:
            return "no_evidence";
        case Verdict::refused:
            return "refused";
    }
    return "refused";
}

}  // namespace culet
