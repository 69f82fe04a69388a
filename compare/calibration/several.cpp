#include "compare/calibration/several.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "compare/calibration/calibrated_verdict_json.h"
#include "page/html.h"
#include "page/json_fields.h"

namespace culet {

namespace {

using OrderedJson = nlohmann::ordered_json;

EquivalentError combined(const std::vector<const EquivalentError*>& errors) {
    EquivalentError result;
    double sum = 0, weights = 0;
    for (const EquivalentError* e : errors) {
        if (e == nullptr) continue;
        // The interval is +-1.96 standard deviations of the logarithm.
        const double sd = std::log(e->high_deg / *e->deg) / 1.96;
        const double w = 1 / std::max(1e-4, sd * sd);
        sum += w * std::log(*e->deg);
        weights += w;
        result.at_least = result.at_least || e->at_least;
        result.at_most = result.at_most || e->at_most;
    }
    if (!(weights > 0)) return {};
    const double mean = sum / weights;
    double scatter = 0, count = 0;
    for (const EquivalentError* e : errors) {
        if (e == nullptr) continue;
        scatter += std::pow(std::log(*e->deg) - mean, 2);
        ++count;
    }
    const double by_scatter = count > 1 ? scatter / (count - 1) / count : 0;
    const double spread = 1.96 * std::sqrt(std::max(1 / weights, by_scatter));
    result.deg = std::exp(mean);
    result.low_deg = std::exp(mean - spread);
    result.high_deg = std::exp(mean + spread);
    return result;
}

}  // namespace

const EquivalentError* equivalent_of(const PhotographRow& row) {
    const bool known = row.calibrated && row.calibrated->equivalent.deg;
    return known ? &row.calibrated->equivalent : nullptr;
}

SeveralPhotographs together(const std::vector<PhotographRow>& rows) {
    SeveralPhotographs result;
    std::vector<const EquivalentError*> errors;
    std::map<Verdict, int> votes;
    for (const PhotographRow& row : rows) {
        errors.push_back(equivalent_of(row));
        if (row.comparison.usable()) ++votes[row.comparison.verdict];
    }
    result.together = combined(errors);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::vector<const EquivalentError*> others = errors;
        others[i] = nullptr;
        result.without.push_back(combined(others));
        if (result.together.deg && result.without.back().deg) {
            const double change =
                std::abs(std::log(*result.without.back().deg / *result.together.deg));
            result.largest_change = std::max(result.largest_change, std::exp(change));
        }
    }
    if (votes.empty()) {
        result.verdict = Verdict::refused;
        result.reason = "none of the photographs could be compared";
        return result;
    }
    int most = 0, counted = 0;
    for (const auto& [verdict, count] : votes) {
        counted += count;
        // From the best verdict to the worst, so that the worse one wins a tie.
        if (count < most) continue;
        most = count;
        result.verdict = verdict;
    }
    result.reason = fmt::format("{} of {} photographs: {}", most, counted, name_of(result.verdict));
    std::replace(result.reason.begin(), result.reason.end(), '_', ' ');
    if (result.together.deg) {
        result.reason += fmt::format(
            "; together they fit as well as the same stone with {} degrees of facet error",
            significant(result.together.deg, 2));
        if (rows.size() > 2) {
            result.reason += fmt::format(
                ", and leaving any one out changes that by a factor of {} "
                "at most",
                significant(result.largest_change, 3));
        }
    }
    return result;
}

std::string several_json(const SeveralPhotographs& several,
                         const std::vector<PhotographRow>& rows) {
    OrderedJson json;
    json["schema"] = 1;
    json["command"] = "compare";
    json["verdict"] = name_of(several.verdict);
    json["reason"] = several.reason;
    json["equivalent_facet_error_deg"] = json_number<OrderedJson>(several.together.deg);
    json["equivalent_facet_error"] = equivalent_json(several.together);
    json["leave_one_out"] = OrderedJson::array();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        json["leave_one_out"].push_back(
            {{"without", rows[i].name},
             {"equivalent_facet_error", equivalent_json(several.without[i])}});
    }
    json["largest_change_factor"] = json_number<OrderedJson>(several.largest_change);
    json["photographs"] = OrderedJson::array();
    for (const PhotographRow& row : rows) {
        json["photographs"].push_back(OrderedJson::parse(row.scores_json, nullptr, false));
    }
    return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace culet
