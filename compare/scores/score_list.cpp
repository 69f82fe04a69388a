#include "compare/scores/score_list.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compare/scores/flip.h"
#include "compare/scores/structure.h"

namespace culet {

namespace {

constexpr const char* k_flat = "one of the pictures has one brightness everywhere";
constexpr const char* k_no_reflex = "the photo has no reflex that stands out";

std::optional<double> of_reflexes(const Measures& m, double ReflexMatch::*part) {
    return m.reflexes ? std::optional((*m.reflexes).*part) : std::nullopt;
}

using enum ScoreScale;

// In the order in which they are reported.
constexpr ScoreKind k_kinds[] = {
    {"zncc", "Pattern of light",
     "ZNCC at 2 %: the same places bright and dark, seen through a blur of 2 % of the stone; 1 is "
     "perfect",
     3, correlation, Needs::photometry, InCalibration::photometric,
     [](const Measures& m) { return m.zncc[0]; }, k_flat},
    {"zncc_1pct", "Pattern of light, finer", "ZNCC at 1 %: the same through half the blur", 3,
     correlation, Needs::photometry, InCalibration::photometric,
     [](const Measures& m) { return m.zncc[1]; }, k_flat},
    {"zncc_4pct", "Pattern of light, coarser", "ZNCC at 4 %: the same through twice the blur", 3,
     correlation, Needs::photometry, InCalibration::photometric,
     [](const Measures& m) { return m.zncc[2]; }, k_flat},
    {"reflex_f1", "Bright spots found",
     "F1: bright spots of one picture found in the other, 0 to 1", 3, up_to_one, Needs::geometry,
     InCalibration::no, [](const Measures& m) { return of_reflexes(m, &ReflexMatch::f1); },
     k_no_reflex},
    {"reflex_area_f1", "Bright spots found, by area", "the same, large spots count more", 3,
     up_to_one, Needs::geometry, InCalibration::always,
     [](const Measures& m) { return of_reflexes(m, &ReflexMatch::area_f1); }, k_no_reflex},
    {"reflex_hue", "Bright spots of one hue",
     "of the coloured spots that were found, those with the photo's hue, 0 to 1", 2, up_to_one,
     Needs::photometry, InCalibration::no,
     [](const Measures& m) { return m.reflexes ? m.reflexes->hue_agreement : std::nullopt; },
     "no matched reflex is coloured in the photo"},
    {"cw_ssim", "Facets' images in place",
     "CW-SSIM: are the facets' images where they should be; hardly minds the light; 1 is perfect",
     3, up_to_one, Needs::geometry, InCalibration::always,
     [](const Measures& m) {
         return std::optional(cw_ssim(m.shown, m.pictures.mask, *m.wavelets));
     }},
    {"ssim", "Structure",
     "SSIM: likeness of each neighbourhood; for comparison with the literature only", 3, up_to_one,
     Needs::photometry, InCalibration::photometric,
     [](const Measures& m) { return std::optional(m.structure.mean); }},
    {"gmsd", "Edges",
     "GMSD: how differently sharp the edges are, 0 is alike; for comparison with the literature "
     "only",
     3, down_to_zero, Needs::geometry, InCalibration::geometry_only,
     [](const Measures& m) { return gmsd(m.shown, m.pictures.mask); }, "too few pixels"},
    {"nmi", "Brightness, any tone curve",
     "mutual information: does one picture's brightness tell the other's, whatever the tone curve",
     3, down_to_one, Needs::geometry, InCalibration::always,
     [](const Measures& m) { return normalized_information(m.shown, m.pictures.mask); }, k_flat},
    {"psnr", "Error of the colours, dB",
     "PSNR: error of the encoded colours against full scale, 10 dB more is a third of it", 1,
     decibel, Needs::photometry, InCalibration::photometric,
     [](const Measures& m) { return psnr(m.shown, m.pictures.mask); },
     "the pictures are equal: there is no noise to measure"},
    {"deltaE00_mean", "Colour difference", "ΔE00 (CIEDE2000), mean: 1 is just visible", 2,
     down_to_zero, Needs::photometry, InCalibration::photometric,
     [](const Measures& m) { return std::optional(m.colour.mean); }},
    {"deltaE00_p95", "Colour difference, 95 %", "ΔE00 that 95 % of the stone stay under", 2,
     down_to_zero, Needs::photometry, InCalibration::no,
     [](const Measures& m) { return std::optional(m.colour.percentile_95); }},
    {"body_deltaE00", "Body colour difference",
     "ΔE00 between the mean colours: material and white balance", 2, down_to_zero,
     Needs::photometry, InCalibration::no,
     [](const Measures& m) { return std::optional(m.colours.body_difference); }},
    {"colour_emd", "Colours, wherever they are",
     "EMD (earth mover's distance): how far colours must be moved to be the photo's", 2,
     down_to_zero, Needs::photometry, InCalibration::no,
     [](const Measures& m) { return std::optional(m.colours.emd); }},
    {"flip_mean", "Difference to the eye",
     "FLIP, mean: what shows when the two are flicked between, 0 is nothing", 3, down_to_zero,
     Needs::photometry, InCalibration::photometric,
     [](const Measures& m) { return std::optional(m.visible.mean); }},
    {k_facet_tilts, "Tilted facets, °", "how much of the difference is what tilted facets change",
     3, down_to_zero, Needs::photometry, InCalibration::photometric,
     [](const Measures& m) { return m.facet_error_deg; }, "the facets' tilts were not read", true},
};

}  // namespace

std::span<const ScoreKind> score_kinds() {
    return k_kinds;
}

const ScoreKind* score_kind(const std::string& key) {
    const auto kind = std::find_if(std::begin(k_kinds), std::end(k_kinds),
                                   [&](const ScoreKind& k) { return key == k.key; });
    return kind != std::end(k_kinds) ? kind : nullptr;
}

Measures measures_of(const MatchedPictures& pictures, const WaveletBank& wavelets) {
    Measures measures;
    measures.pictures = pictures;
    measures.shown = shown(pictures);
    measures.wavelets = &wavelets;
    measures.zncc = zncc(pictures, {0.02, 0.01, 0.04});
    measures.reflexes = match_reflexes(pictures);
    measures.structure = ssim(measures.shown, pictures.mask);
    measures.visible = flip(pictures);
    measures.colour = deltaE00(pictures);
    measures.colours = colour_distributions(pictures);
    return measures;
}

std::vector<Score> scores_of(const Measures& measures) {
    std::vector<Score> scores;
    for (const ScoreKind& kind : k_kinds) {
        if (kind.calibrated_only && !measures.calibrating) continue;
        Score score;
        score.key = kind.key;
        score.value = kind.read(measures);
        score.higher_is_better = kind.higher_is_better();
        score.is_correlation = kind.scale == ScoreScale::correlation;
        if (!score.value) score.note = kind.why_none;
        scores.push_back(std::move(score));
    }
    return scores;
}

void keep_geometry_only(std::vector<Score>& scores, const std::string& why) {
    for (Score& score : scores) {
        const ScoreKind* kind = score_kind(score.key);
        if (kind != nullptr && kind->needs == Needs::geometry) continue;
        score.value.reset();
        score.note = why;
    }
}

double stabilised(double score, ScoreScale scale) {
    const auto towards = [](double left) { return -std::log(std::max(1e-4, left)); };
    switch (scale) {
        case ScoreScale::correlation:
        case ScoreScale::up_to_one:
            return towards(1 - score);
        case ScoreScale::down_to_zero:
            return towards(score);
        case ScoreScale::down_to_one:
            return -towards(score - 1);
        case ScoreScale::decibel:
            break;
    }
    return score;
}

void fill_null(Score& score) {
    if (score.null.empty()) return;
    const auto n = static_cast<double>(score.null.size());
    double sum = 0, squares = 0;
    for (const double v : score.null) sum += v;
    score.null_mean = sum / n;
    for (const double v : score.null) squares += (v - score.null_mean) * (v - score.null_mean);
    score.null_sd = n > 1 ? std::sqrt(squares / (n - 1)) : 0;
    if (!score.value) return;
    const double sign = score.higher_is_better ? 1 : -1;
    if (score.is_correlation) {
        Score stabilised_scores = score;
        stabilised_scores.is_correlation = false;
        stabilised_scores.value = std::atanh(std::clamp(*score.value, -0.9999, 0.9999));
        for (double& v : stabilised_scores.null) v = std::atanh(std::clamp(v, -0.9999, 0.9999));
        fill_null(stabilised_scores);
        score.z = stabilised_scores.z;
    } else if (score.null_sd > 0) {
        score.z = sign * (*score.value - score.null_mean) / score.null_sd;
    }
    double as_good = 0;
    for (const double v : score.null) as_good += sign * v >= sign * *score.value ? 1 : 0;
    score.p = (as_good + 1) / (n + 1);
}

}  // namespace culet
