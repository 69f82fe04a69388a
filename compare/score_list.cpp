#include "compare/score_list.h"

#include <algorithm>
#include <cmath>

#include "compare/colour_distribution.h"
#include "compare/flip.h"
#include "compare/structure.h"

namespace culet {

namespace {

Score score(std::string key, std::optional<double> value, bool higher_is_better = true,
            std::string note = {}) {
    Score s;
    s.key = std::move(key);
    s.value = value;
    s.higher_is_better = higher_is_better;
    s.is_correlation = s.key.starts_with("zncc");
    if (!value) s.note = std::move(note);
    return s;
}

}  // namespace

Measured measure(const MatchedPictures& pictures, const WaveletBank& wavelets) {
    const std::string flat = "one of the pictures has one brightness everywhere";
    Measured result;
    auto& scores = result.scores;
    scores.push_back(score("zncc", zncc(pictures, 0.02), true, flat));
    scores.push_back(score("zncc_1pct", zncc(pictures, 0.01), true, flat));
    scores.push_back(score("zncc_4pct", zncc(pictures, 0.04), true, flat));

    result.reflexes = match_reflexes(pictures);
    const auto& reflexes = result.reflexes;
    const auto of_reflexes = [&](double ReflexMatch::* part) {
        return reflexes ? std::optional((*reflexes).*part) : std::nullopt;
    };
    const std::string none = "the photo has no reflex that stands out";
    scores.push_back(score("reflex_f1", of_reflexes(&ReflexMatch::f1), true, none));
    scores.push_back(score("reflex_area_f1", of_reflexes(&ReflexMatch::area_f1), true, none));
    scores.push_back(score("reflex_hue", reflexes ? reflexes->hue_agreement : std::nullopt, true,
                           "no matched reflex is coloured in the photo"));

    const ShownPictures pair = shown(pictures);
    scores.push_back(score("cw_ssim", cw_ssim(pair, pictures.mask, wavelets)));
    const ScoreMap structure = ssim(pair, pictures.mask);
    scores.push_back(score("ssim", structure.mean));
    scores.push_back(score("gmsd", gmsd(pair, pictures.mask), false, "too few pixels"));
    scores.push_back(score("nmi", normalized_information(pair, pictures.mask), true, flat));
    scores.push_back(score("psnr", psnr(pair, pictures.mask), true,
                           "the pictures are equal: there is no noise to measure"));

    const ColourScore colour = deltaE00(pictures);
    scores.push_back(score("deltaE00_mean", colour.mean, false));
    scores.push_back(score("deltaE00_p95", colour.percentile_95, false));
    const ColourDistributions colours = colour_distributions(pictures);
    scores.push_back(score("body_deltaE00", colours.body_difference, false));
    scores.push_back(score("colour_emd", colours.emd, false));
    const ScoreMap visible = flip(pictures);
    scores.push_back(score("flip_mean", visible.mean, false));

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
