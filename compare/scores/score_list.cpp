#include "compare/scores/score_list.h"

#include <algorithm>
#include <cmath>

#include "compare/scores/colour_distribution.h"
#include "compare/scores/flip.h"
#include "compare/scores/structure.h"

namespace culet {

namespace {

// In the order of `score_kinds`.
class List {
public:
    void add(std::optional<double> value, const std::string& why_none = {}) {
        const ScoreKind& kind = score_kinds().at(scores.size());
        Score score;
        score.key = kind.key;
        score.value = value;
        score.higher_is_better = kind.higher_is_better;
        score.is_correlation = score.key.starts_with("zncc");
        if (!value) score.note = why_none;
        scores.push_back(std::move(score));
    }
    std::vector<Score> scores;
};

}  // namespace

const std::vector<ScoreKind>& score_kinds() {
    static const std::vector<ScoreKind> kinds{
        {"zncc", true, false},          {"zncc_1pct", true, false},
        {"zncc_4pct", true, false},     {"reflex_f1", true, true},
        {"reflex_area_f1", true, true}, {"reflex_hue", true, false},
        {"cw_ssim", true, true},        {"ssim", true, false},
        {"gmsd", false, true},          {"nmi", true, true},
        {"psnr", true, false},          {"deltaE00_mean", false, false},
        {"deltaE00_p95", false, false}, {"body_deltaE00", false, false},
        {"colour_emd", false, false},   {"flip_mean", false, false}};
    return kinds;
}

void keep_geometry_only(std::vector<Score>& scores, const std::string& why) {
    for (Score& score : scores) {
        const auto kind = std::find_if(score_kinds().begin(), score_kinds().end(),
                                       [&](const ScoreKind& k) { return score.key == k.key; });
        if (kind != score_kinds().end() && kind->geometry) continue;
        score.value.reset();
        score.note = why;
    }
}

Measured measure(const MatchedPictures& pictures, const WaveletBank& wavelets) {
    const std::string flat = "one of the pictures has one brightness everywhere";
    Measured result;
    List scores;
    for (const auto& correlation : zncc(pictures, {0.02, 0.01, 0.04}))
        scores.add(correlation, flat);

    result.reflexes = match_reflexes(pictures);
    const auto& reflexes = result.reflexes;
    const auto of_reflexes = [&](double ReflexMatch::*part) {
        return reflexes ? std::optional((*reflexes).*part) : std::nullopt;
    };
    const std::string none = "the photo has no reflex that stands out";
    scores.add(of_reflexes(&ReflexMatch::f1), none);
    scores.add(of_reflexes(&ReflexMatch::area_f1), none);
    scores.add(reflexes ? reflexes->hue_agreement : std::nullopt,
               "no matched reflex is coloured in the photo");

    const ShownPictures pair = shown(pictures);
    scores.add(cw_ssim(pair, pictures.mask, wavelets));
    const ScoreMap structure = ssim(pair, pictures.mask);
    scores.add(structure.mean);
    scores.add(gmsd(pair, pictures.mask), "too few pixels");
    scores.add(normalized_information(pair, pictures.mask), flat);
    scores.add(psnr(pair, pictures.mask), "the pictures are equal: there is no noise to measure");

    const ColourScore colour = deltaE00(pictures);
    scores.add(colour.mean);
    scores.add(colour.percentile_95);
    const ColourDistributions colours = colour_distributions(pictures);
    scores.add(colours.body_difference);
    scores.add(colours.emd);
    const ScoreMap visible = flip(pictures);
    scores.add(visible.mean);

    result.scores = std::move(scores.scores);
    result.flip_map = visible.map;
    result.ssim_map = structure.map;
    result.colour_map = colour.map;
    return result;
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
        Score stretched = score;
        stretched.is_correlation = false;
        stretched.value = std::atanh(std::clamp(*score.value, -0.9999, 0.9999));
        for (double& v : stretched.null) v = std::atanh(std::clamp(v, -0.9999, 0.9999));
        fill_null(stretched);
        score.z = stretched.z;
    } else if (score.null_sd > 0) {
        score.z = sign * (*score.value - score.null_mean) / score.null_sd;
    }
    double as_good = 0;
    for (const double v : score.null) as_good += sign * v >= sign * *score.value ? 1 : 0;
    score.p = (as_good + 1) / (n + 1);
}

}  // namespace culet
