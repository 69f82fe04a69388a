#include "compare/calibration/calibrated_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/scores/score_list.h"
#include "page/html.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

constexpr const char* k_primary = "zncc";

// Limits on the equivalent facet error for a verdict: see docs/meaning.md.
constexpr double k_match_deg = 0.7, k_partial_deg = 1.4;
// A slightly turned light may do nearly as well as the right one: one draw of 24 may.
constexpr double k_most_p = 0.1, k_least_z = 2;

std::size_t index_of(const Calibration& calibration, const std::string& key) {
    const auto at = std::find(calibration.keys.begin(), calibration.keys.end(), key);
    return static_cast<std::size_t>(at - calibration.keys.begin());
}

std::vector<std::optional<double>> values_of(const std::vector<Score>& scores,
                                             const Calibration& calibration) {
    std::vector<std::optional<double>> values(calibration.keys.size());
    for (const Score& score : scores) {
        const std::size_t k = index_of(calibration, score.key);
        if (k < values.size()) values[k] = score.value;
    }
    return values;
}

std::optional<NullStatistics> null_statistics(Alternative alternative, const Score& photo,
                                              const Calibration& calibration,
                                              const FacetErrorScale& scale,
                                              std::optional<double> photo_rank) {
    const std::size_t primary = index_of(calibration, photo.key);
    Score against = photo;
    against.null.clear();
    std::vector<double> ranks, errors;
    for (const CalibrationDraw& draw : calibration.draws) {
        if (draw.alternative != alternative) continue;
        if (draw.scores[primary]) against.null.push_back(*draw.scores[primary]);
        // A draw that could not be registered counts as the worst possible.
        const EquivalentError error = scale.of(draw.scores);
        ranks.push_back(error.rank.value_or(scale.largest_rank()));
        errors.push_back(error.deg.value_or(std::exp(scale.largest_rank())));
    }
    if (against.null.size() < 5) return std::nullopt;
    fill_null(against);
    NullStatistics statistics;
    statistics.alternative = alternative;
    statistics.draws = static_cast<int>(ranks.size());
    statistics.mean = against.null_mean;
    statistics.sd = against.null_sd;
    statistics.z = against.z.value_or(0);
    if (photo_rank) {
        statistics.as_good = static_cast<int>(std::count_if(
            ranks.begin(), ranks.end(), [&](double rank) { return rank <= *photo_rank; }));
        statistics.p = (statistics.as_good + 1.0) / (statistics.draws + 1.0);
    }
    statistics.least_deg = *std::min_element(errors.begin(), errors.end());
    statistics.median_deg = upper_median(std::move(errors));
    return statistics;
}

bool takes_part(const std::string& key, bool geometry_only) {
    const ScoreKind* kind = score_kind(key);
    if (kind == nullptr) return false;
    return kind->in_calibration == InCalibration::always ||
           kind->in_calibration ==
               (geometry_only ? InCalibration::geometry_only : InCalibration::photometric);
}

std::string degrees_in_words(double deg) {
    return significant(deg, 2) + (deg == 1 ? " degree" : " degrees");
}

// "with facets off by 0.5 degrees (0.34 to 0.75)"
std::string facets_off(const EquivalentError& error) {
    const std::string deg = degrees_in_words(*error.deg);
    if (error.at_least) return "with facets off by " + deg + " or more";
    if (error.at_most) return "with facets off by no more than " + deg;
    return fmt::format("with facets off by {} ({} to {})", deg, significant(error.low_deg, 2),
                       significant(error.high_deg, 2));
}

// The nearest of the wrong lights and poses.
std::string chance_in_words(const CalibratedVerdict& verdict) {
    if (verdict.nulls.empty()) return "";
    const NullStatistics& worst = verdict.nulls.front();
    const char* what = worst.alternative == Alternative::light  ? "lights"
                       : worst.alternative == Alternative::pose ? "poses"
                                                                : "lights and poses";
    return fmt::format("; {} of {} wrong {} agree as well", worst.as_good, worst.draws, what);
}

std::string headline_of(const CalibratedVerdict& verdict, const std::string& against) {
    const EquivalentError& error = verdict.equivalent;
    const std::string as_well = error.deg ? ": as well as " + facets_off(error) : "";
    std::string text;
    switch (verdict.verdict) {
        case Verdict::match:
            text = "The photograph agrees with this stone" + as_well;
            break;
        case Verdict::partial:
            text = "The photograph agrees with this stone in part" + as_well;
            break;
        default:
            text = "The photograph does not show that it is this stone: " + against;
            if (error.deg) text += "; it agrees as well as " + facets_off(error);
    }
    return text + chance_in_words(verdict);
}

void judge(CalibratedVerdict& verdict) {
    const bool beaten =
        std::all_of(verdict.nulls.begin(), verdict.nulls.end(), [](const NullStatistics& n) {
            return n.as_good == 0 || (n.p <= k_most_p && n.z >= k_least_z);
        });
    const EquivalentError& error = verdict.equivalent;
    std::string against;
    verdict.verdict = Verdict::no_evidence;
    if (verdict.nulls.empty() || !error.deg) {
        against = "too few draws to tell a match from chance (raise --budget)";
    } else if (!beaten) {
        against = "a wrong light or pose fits as well";
    } else if (*error.deg <= k_match_deg) {
        verdict.verdict = Verdict::match;
    } else if (*error.deg <= k_partial_deg) {
        verdict.verdict = Verdict::partial;
    } else {
        against = "a stone with quite other facets fits as well";
    }
    verdict.headline = headline_of(verdict, against);
}

}  // namespace

const char* const k_calibrated_rule =
    "match: an equivalent facet error of 0.7 degrees at most, and for each null (a wrong light, a "
    "wrong pose, both) either below that of every draw, or p at most 0.1 with zncc 2 standard "
    "deviations above its mean; partial: the same up to 1.4 degrees; else no_evidence.";

CalibratedVerdict calibrated_verdict(const std::vector<Score>& scores, Calibration calibration,
                                     bool geometry_only) {
    CalibratedVerdict verdict;
    verdict.geometry_only = geometry_only;
    std::vector<std::string> keys;
    for (const std::string& key : calibration.keys) {
        if (takes_part(key, geometry_only)) keys.push_back(key);
    }
    const FacetErrorScale scale(calibration, keys);
    const auto values = values_of(scores, calibration);
    verdict.equivalent = scale.of(values);
    verdict.curves = scale.curves(values);
    const std::optional<double> rank = verdict.equivalent.rank;
    verdict.evidence = -rank.value_or(scale.largest_rank());

    const std::string primary = geometry_only ? "cw_ssim" : k_primary;
    for (const Score& score : scores) {
        if (score.key != primary || !score.value) continue;
        for (const Alternative alternative :
             {Alternative::light, Alternative::pose, Alternative::both}) {
            if (auto statistics = null_statistics(alternative, score, calibration, scale, rank)) {
                verdict.nulls.push_back(*statistics);
            }
        }
    }
    std::stable_sort(verdict.nulls.begin(), verdict.nulls.end(),
                     [](const NullStatistics& a, const NullStatistics& b) { return a.z < b.z; });
    const std::size_t zncc = index_of(calibration, k_primary);
    for (const CalibrationDraw& draw : calibration.draws) {
        if (draw.alternative != Alternative::catalogue &&
            draw.alternative != Alternative::material && draw.alternative != Alternative::wrong) {
            continue;
        }
        verdict.hypotheses.push_back(
            {draw.alternative, draw.name, draw.scores[zncc], scale.of(draw.scores)});
    }
    verdict.calibration = std::move(calibration);
    judge(verdict);
    return verdict;
}

}  // namespace culet
