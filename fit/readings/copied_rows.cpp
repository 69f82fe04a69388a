#include "fit/readings/copied_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace culet {

namespace {

constexpr double k_chance = 1e-3;
constexpr int k_most_digits = 9;

// The step of the last digit: 0.01 for 34.25.
double last_digit(double value) {
    double step = 1;
    for (int digit = 0; digit < k_most_digits; ++digit, step /= 10) {
        if (std::abs(value / step - std::round(value / step)) < 1e-6) break;
    }
    return step;
}

bool is_plain(const WrittenReading& w) {
    return !w.skipped && !w.outlines && !w.exact && !w.released && w.value && w.sigma &&
           *w.sigma > 0;
}

// Rows of one kind and unit share a scale.
auto scale_of(const WrittenReading& w) {
    return std::make_pair(w.kind, w.value_unit.word);
}

// Bound on the probability that two readings of one quantity show the same number.
double chance_alike(const WrittenReading& w, double finest) {
    const double sigma = *w.sigma * w.sigma_unit.factor / w.value_unit.factor;
    const double step = w.rounding ? *w.rounding * w.rounding_unit.factor / w.value_unit.factor
                                   : std::min(finest, std::sqrt(12.0) * sigma);
    return std::erf(step / (2 * std::sqrt(2.0) * sigma));
}

}  // namespace

std::vector<bool> copied_rows(const std::vector<WrittenReading>& written) {
    std::map<std::pair<std::string, std::string>, double> finest;
    for (const WrittenReading& w : written) {
        if (!is_plain(w)) continue;
        const auto [at, fresh] = finest.try_emplace(scale_of(w), last_digit(*w.value));
        if (!fresh) at->second = std::min(at->second, last_digit(*w.value));
    }
    std::vector<bool> copies(written.size(), false);
    std::map<std::tuple<std::string, std::vector<std::string>, std::string, std::string>,
             std::vector<std::size_t>>
        known;
    double repeated = 0, alike = 0, expected = 0;
    for (std::size_t i = 0; i < written.size(); ++i) {
        const WrittenReading& w = written[i];
        if (!is_plain(w)) continue;
        std::vector<std::size_t>& before = known[{w.kind, w.of, w.datum, w.side}];
        if (!before.empty()) {
            ++repeated;
            expected += chance_alike(w, finest[scale_of(w)]);
            copies[i] = std::any_of(before.begin(), before.end(), [&](std::size_t other) {
                const WrittenReading& o = written[other];
                return *o.value == *w.value && *o.sigma == *w.sigma &&
                       o.value_unit.word == w.value_unit.word;
            });
            alike += copies[i] ? 1 : 0;
        }
        before.push_back(i);
    }
    const auto share = [&](double part, double chance) {
        return part > 0 ? part * std::log(part / chance) : 0;
    };
    const double part = repeated > 0 ? alike / repeated : 0,
                 chance = repeated > 0 ? expected / repeated : 1;
    const bool by_chance =
        !(part > chance) ||
        -repeated * (share(part, chance) + share(1 - part, 1 - chance)) > std::log(k_chance);
    if (by_chance) copies.assign(written.size(), false);
    return copies;
}

}  // namespace culet
