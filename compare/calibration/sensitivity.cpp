#include "compare/calibration/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "compare/calibration/level_curve.h"
#include "compare/scores/score_list.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

struct Moments {
    int count = 0;
    double mean = 0, sd = 0;
};

Moments moments(const std::vector<double>& values) {
    Moments m;
    m.count = static_cast<int>(values.size());
    if (values.empty()) return m;
    m.mean = std::accumulate(values.begin(), values.end(), 0.0) / m.count;
    double squares = 0;
    for (const double v : values) squares += (v - m.mean) * (v - m.mean);
    m.sd = m.count > 1 ? std::sqrt(squares / (m.count - 1)) : 0;
    return m;
}

// Two scores may agree by chance on eight draws, so no sigma below 10 % is believed.
constexpr double k_least_variance = 0.1 * 0.1;

}  // namespace

std::vector<double> facet_errors_deg() {
    return {0.02, 0.05, 0.1, 0.2, 0.5, 1, 2};
}

FacetErrorScale::FacetErrorScale(const Calibration& calibration,
                                 const std::vector<std::string>& keys) {
    DrawsByLevel by_level;
    for (const CalibrationDraw& draw : calibration.draws) {
        if (draw.alternative == Alternative::facet_error)
            by_level[draw.facet_error_deg].push_back(&draw);
    }
    for (const auto& [deg, draws] : by_level) {
        levels_deg_.push_back(deg);
        levels_.push_back(std::log(std::max(deg, k_least_deg)));
    }
    if (levels_.size() < 3) return;

    for (std::size_t k = 0; k < calibration.keys.size(); ++k) {
        if (std::find(keys.begin(), keys.end(), calibration.keys[k]) == keys.end()) continue;
        const ScoreKind* kind = score_kind(calibration.keys[k]);
        if (kind == nullptr) continue;
        std::optional<Curve> curve = curve_of(k, *kind, by_level);
        if (curve) curves_.push_back(std::move(*curve));
    }
    if (curves_.empty()) return;

    std::vector<double> means;
    for (const auto& [deg, draws] : by_level) {
        std::vector<double> answers;
        for (const CalibrationDraw* draw : draws) {
            if (const auto answer = averaged(draw->scores)) answers.push_back(*answer);
        }
        means.push_back(moments(answers).mean);
    }
    average_ = monotone(means);
    const JointDraws draws = joint_draws(calibration);
    joint_ = JointScores(draws);
    fit_regression(draws);
}

std::optional<FacetErrorScale::Curve> FacetErrorScale::curve_of(
    std::size_t key, const ScoreKind& kind, const DrawsByLevel& by_level) const {
    Curve curve;
    curve.key = key;
    curve.kind = &kind;
    std::vector<double> stabilised_scores;
    for (const auto& [deg, draws] : by_level) {
        std::vector<double> values, on_scale;
        for (const CalibrationDraw* draw : draws) {
            if (!draw->scores[key]) continue;
            values.push_back(*draw->scores[key]);
            on_scale.push_back(stabilised(values.back(), kind.scale));
        }
        if (values.empty()) return std::nullopt;
        const Moments plain = moments(values);
        curve.mean.push_back(plain.mean);
        curve.sd.push_back(plain.sd);
        curve.draws.push_back(plain.count);
        stabilised_scores.push_back(moments(on_scale).mean);
    }
    curve.stabilised_scores = falling(stabilised_scores);
    if (!(curve.stabilised_scores.front() > curve.stabilised_scores.back())) return std::nullopt;
    const double sign = kind.higher_is_better() ? 1 : -1;
    std::vector<double> better = curve.mean;
    for (double& v : better) v *= sign;
    curve.fitted = falling(better);
    for (double& v : curve.fitted) v *= sign;
    // The scatter of this score's answers.
    for (const auto& [deg, draws] : by_level) {
        const double level = levels_[curve.variance.size()];
        double squares = 0, count = 0;
        for (const CalibrationDraw* draw : draws) {
            if (!draw->scores[key]) continue;
            const double off = logarithm(curve, *draw->scores[key]) - level;
            squares += off * off;
            ++count;
        }
        curve.variance.push_back(squares / count);
    }
    curve.variance = smoothed(curve.variance);
    return curve;
}

void FacetErrorScale::fit_regression(const JointDraws& draws) {
    // The ceiling (error 0) has no logarithm and is left out.
    std::vector<double> errors;
    std::vector<std::vector<double>> scores;
    std::vector<std::size_t> level_of;
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        if (!(levels_deg_[l] > 0)) continue;
        for (const auto& draw : draws.draws[l]) {
            errors.push_back(levels_[l]);
            scores.push_back(draw);
            level_of.push_back(l);
        }
    }
    regression_ = ErrorRegression(std::move(errors), std::move(scores));
    std::vector<double> squares(levels_.size(), 0), counts(levels_.size(), 0);
    for (std::size_t i = 0; i < regression_.left_out().size(); ++i) {
        const double off = regression_.left_out()[i];
        if (std::isnan(off)) continue;
        squares[level_of[i]] += off * off;
        ++counts[level_of[i]];
    }
    // A level without a variance takes that of the next one.
    std::vector<double> variances(levels_.size(), 1);
    for (std::size_t l = levels_.size(); l-- > 0;) {
        if (counts[l] > 0)
            variances[l] = squares[l] / counts[l];
        else if (l + 1 < levels_.size())
            variances[l] = variances[l + 1];
    }
    spread_.clear();
    for (const double v : smoothed(variances)) {
        spread_.push_back(std::sqrt(std::max(v, k_least_variance)));
    }
}

JointDraws FacetErrorScale::joint_draws(const Calibration& calibration) const {
    JointDraws joint;
    joint.levels = levels_;
    joint.draws.resize(levels_.size());
    for (const Curve& curve : curves_) joint.curves.push_back(curve.stabilised_scores);
    for (const CalibrationDraw& draw : calibration.draws) {
        if (draw.alternative != Alternative::facet_error) continue;
        const auto level = std::find(levels_deg_.begin(), levels_deg_.end(), draw.facet_error_deg);
        joint.draws[static_cast<std::size_t>(level - levels_deg_.begin())].push_back(
            stabilised_scores(draw.scores));
    }
    return joint;
}

std::vector<double> FacetErrorScale::stabilised_scores(
    const std::vector<std::optional<double>>& scores) const {
    std::vector<double> result;
    for (const Curve& curve : curves_) {
        const std::optional<double>& score = scores[curve.key];
        result.push_back(score ? stabilised(*score, curve.kind->scale)
                               : std::numeric_limits<double>::quiet_NaN());
    }
    return result;
}

std::optional<FacetErrorScale::Explained> FacetErrorScale::explained(
    const std::vector<std::optional<double>>& scores) const {
    const auto average = averaged(scores);
    const auto joint = joint_.of(stabilised_scores(scores));
    if (!average || !joint) return std::nullopt;
    if (joint->misfit <= 1) {
        const auto found = regression_.of(stabilised_scores(scores));
        if (found)
            return Explained{std::clamp(*found, levels_.front(), levels_.back()), joint->misfit};
    }
    // `average_` rises with the levels; inverse_of_falling needs falling values.
    std::vector<double> negative = average_;
    for (double& v : negative) v = -v;
    return Explained{inverse_of_falling(levels_, negative, -*average), joint->misfit};
}

double FacetErrorScale::logarithm(const Curve& curve, double score) const {
    return inverse_of_falling(levels_, curve.stabilised_scores,
                              stabilised(score, curve.kind->scale));
}

double FacetErrorScale::weight(const Curve& curve, double log_deg) const {
    return 1 / std::max(k_least_variance, interpolated(levels_, curve.variance, log_deg));
}

std::optional<double> FacetErrorScale::averaged(
    const std::vector<std::optional<double>>& scores) const {
    std::vector<double> answers;
    std::vector<const Curve*> of;
    for (const Curve& curve : curves_) {
        if (!scores[curve.key]) continue;
        answers.push_back(logarithm(curve, *scores[curve.key]));
        of.push_back(&curve);
    }
    if (answers.empty()) return std::nullopt;
    // The weights depend on the answer: iterate from the median.
    double answer = upper_median(answers);
    for (int round = 0; round < 8; ++round) {
        double sum = 0, weights = 0;
        for (std::size_t i = 0; i < answers.size(); ++i) {
            const double w = weight(*of[i], answer);
            sum += w * answers[i];
            weights += w;
        }
        answer = sum / weights;
    }
    return answer;
}

EquivalentError FacetErrorScale::of(const std::vector<std::optional<double>>& scores) const {
    EquivalentError result;
    if (!usable()) return result;
    const auto found = explained(scores);
    if (!found) return result;
    const double log_deg = found->log_deg;
    const double spread = 1.96 * interpolated(levels_, spread_, log_deg);
    result.deg = std::exp(log_deg);
    result.rank = log_deg + 0.5 * std::log(std::max(1.0, found->misfit));
    result.low_deg = std::exp(log_deg - spread);
    result.high_deg = std::exp(log_deg + spread);
    result.at_least = log_deg >= levels_.back() - 1e-9;
    result.at_most = log_deg <= std::log(levels_deg_[1]) + 1e-9;
    if (result.at_most) {
        result.deg = std::exp(levels_[1]);
        result.low_deg = 0;
    }
    return result;
}

std::vector<SensitivityCurve> FacetErrorScale::curves(
    const std::vector<std::optional<double>>& scores) const {
    std::vector<SensitivityCurve> result;
    if (!usable()) return result;
    const double at = averaged(scores).value_or(levels_.back());
    double weights = 0;
    for (const Curve& curve : curves_) {
        SensitivityCurve shown;
        shown.key = curve.kind->key;
        shown.higher_is_better = curve.kind->higher_is_better();
        for (std::size_t i = 0; i < levels_.size(); ++i) {
            shown.levels.push_back(
                {levels_deg_[i], curve.draws[i], curve.mean[i], curve.sd[i], curve.fitted[i]});
        }
        shown.value = scores[curve.key];
        if (shown.value) {
            shown.equivalent_deg = std::exp(logarithm(curve, *shown.value));
            shown.weight = weight(curve, at);
            weights += shown.weight;
        }
        result.push_back(std::move(shown));
    }
    for (SensitivityCurve& curve : result) curve.weight /= weights > 0 ? weights : 1;
    return result;
}

}  // namespace culet
