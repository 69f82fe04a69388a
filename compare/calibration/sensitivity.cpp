#include "compare/calibration/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "compare/calibration/level_curve.h"
#include "compare/scores/score_list.h"

namespace culet {

namespace {

// Two scores may agree by chance on eight draws: none is believed to better than 10 %.
constexpr double k_least_variance = 0.1 * 0.1;

using DrawsByLevel = std::map<double, std::vector<const CalibrationDraw*>>;

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
    if (values.size() < 2) return 0;
    const double mean = mean_of(values);
    double squares = 0;
    for (const double v : values) squares += (v - mean) * (v - mean);
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

}  // namespace

std::vector<double> facet_errors_deg() {
    return {0.02, 0.05, 0.1, 0.2, 0.5, 1, 2};
}

FacetErrorScale::FacetErrorScale(const Calibration& calibration,
                                 const std::vector<std::string>& keys) {
    DrawsByLevel by_level;
    for (const CalibrationDraw& draw : calibration.draws) {
        if (draw.world == World::facet_error) by_level[draw.facet_error_deg].push_back(&draw);
    }
    for (const auto& [deg, draws] : by_level)
        levels_.push_back(std::log(std::max(deg, k_least_deg)));
    if (levels_.size() < 3) return;

    for (std::size_t k = 0; k < calibration.keys.size(); ++k) {
        Curve curve;
        curve.key = k;
        curve.kind = score_kind(calibration.keys[k]);
        if (curve.kind == nullptr ||
            std::find(keys.begin(), keys.end(), calibration.keys[k]) == keys.end())
            continue;
        const double sign = curve.kind->higher_is_better() ? 1 : -1;
        std::vector<double> better;
        for (const auto& [deg, draws] : by_level) {
            std::vector<double> values, stretched;
            for (const CalibrationDraw* draw : draws) {
                if (!draw->scores[k]) continue;
                values.push_back(*draw->scores[k]);
                stretched.push_back(stretch(values.back(), curve.kind->scale));
            }
            if (values.empty()) break;
            better.push_back(sign * mean_of(values));
            curve.stretched.push_back(mean_of(stretched));
            curve.levels.push_back(
                {deg, static_cast<int>(values.size()), mean_of(values), deviation_of(values)});
        }
        if (better.size() < levels_.size()) continue;  // a level without any
        curve.stretched = falling(curve.stretched);
        if (!(curve.stretched.front() > curve.stretched.back())) continue;
        better = falling(better);
        for (std::size_t l = 0; l < levels_.size(); ++l) curve.levels[l].fitted = sign * better[l];
        curves_.push_back(std::move(curve));
    }
    if (curves_.empty()) return;

    std::vector<KnownScores> draws;
    for (const auto& [deg, of_level] : by_level) {
        const auto level =
            static_cast<std::size_t>(std::distance(by_level.begin(), by_level.find(deg)));
        for (const CalibrationDraw* draw : of_level)
            draws.push_back({level, stretched(draw->scores)});
    }
    tell_spread(draws);
    std::vector<std::vector<double>> curves;
    for (const Curve& curve : curves_) curves.push_back(curve.stretched);
    misfit_ = ScoreMisfit(levels_, std::move(curves), draws);
    double largest = 0;
    for (const KnownScores& draw : draws) {
        if (const auto error = log_error(draw.scores))
            largest = std::max(largest, misfit_.at(*error, draw.scores).value_or(0));
    }
    if (largest > 0) largest_misfit_ = largest;
}

void FacetErrorScale::tell_spread(const std::vector<KnownScores>& draws) {
    std::vector<double> errors;
    std::vector<std::vector<double>> scores;
    std::vector<std::size_t> level_of;
    for (const KnownScores& draw : draws) {
        // The ceiling has no logarithm.
        if (!(curves_.front().levels[draw.level].facet_error_deg > 0)) continue;
        errors.push_back(levels_[draw.level]);
        scores.push_back(draw.scores);
        level_of.push_back(draw.level);
    }
    regression_ = ErrorRegression(std::move(errors), std::move(scores));
    std::vector<double> squares(levels_.size(), 0), counts(levels_.size(), 0);
    for (std::size_t i = 0; i < regression_.left_out().size(); ++i) {
        const double off = regression_.left_out()[i];
        if (std::isnan(off)) continue;
        squares[level_of[i]] += off * off;
        ++counts[level_of[i]];
    }
    // Where a level has none, the next one's stands for it.
    std::vector<double> variances(levels_.size(), 1);
    for (std::size_t l = levels_.size(); l-- > 0;) {
        if (counts[l] > 0)
            variances[l] = squares[l] / counts[l];
        else if (l + 1 < levels_.size())
            variances[l] = variances[l + 1];
    }
    for (const double v : smoothed(variances))
        spread_.push_back(std::sqrt(std::max(v, k_least_variance)));
}

std::vector<double> FacetErrorScale::stretched(
    const std::vector<std::optional<double>>& scores) const {
    std::vector<double> result;
    for (const Curve& curve : curves_) {
        const std::optional<double>& score = scores[curve.key];
        result.push_back(score ? stretch(*score, curve.kind->scale)
                               : std::numeric_limits<double>::quiet_NaN());
    }
    return result;
}

std::optional<double> FacetErrorScale::log_error(const std::vector<double>& scores) const {
    const auto found = regression_.of(scores);
    if (!found) return std::nullopt;
    return std::clamp(*found, levels_.front(), levels_.back());
}

EquivalentError FacetErrorScale::of(const std::vector<std::optional<double>>& scores) const {
    EquivalentError result;
    if (!usable()) return result;
    const std::vector<double> on_scale = stretched(scores);
    const auto found = log_error(on_scale);
    if (!found) return result;
    const double misfit = misfit_.at(*found, on_scale).value_or(0) / largest_misfit_;
    const double spread = 1.96 * interpolated(levels_, spread_, *found);
    result.deg = std::exp(*found);
    result.rank = *found + 0.5 * std::log(std::max(1.0, misfit));
    result.low_deg = std::exp(*found - spread);
    result.high_deg = std::exp(*found + spread);
    result.at_least = *found >= levels_.back() - 1e-9;
    result.at_most = *found <= levels_[1] + 1e-9;
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
    const std::vector<double> on_scale = stretched(scores);
    const std::vector<double> shares = regression_.shares(on_scale);
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        const Curve& curve = curves_[i];
        SensitivityCurve shown;
        shown.key = curve.kind->key;
        shown.levels = curve.levels;
        shown.higher_is_better = curve.kind->higher_is_better();
        shown.value = scores[curve.key];
        if (shown.value) {
            shown.equivalent_deg =
                std::exp(inverse_of_falling(levels_, curve.stretched, on_scale[i]));
            shown.weight = shares[i];
        }
        result.push_back(std::move(shown));
    }
    return result;
}

}  // namespace culet
