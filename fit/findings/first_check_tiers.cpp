// Finds tiers that are off the mesh as a whole. Their readings agree, so none is odd by itself.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/findings/first_check_rows.h"
#include "fit/findings/words.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

namespace {

// Significance over all tiers, stricter than for readings: a tier is rarely typed wrong. It is
// relaxed for the value of another tier, since where six tiers share 30 degrees, one angle in eight
// is within 0.3 degrees of another tier's by chance.
constexpr double k_tier_level = 0.001, k_level_of_another = 0.008;
constexpr double k_alike = radians(0.3);
// With fewer other tiers nobody knows how far this stone's tiers are off the mesh.
constexpr std::size_t k_fewest_other_tiers = 2;
// The expected scatter counts as one observation, as in the prior.
constexpr double k_stated_count = 1;

struct TierRead {
    const NamedTier* tier = nullptr;
    std::vector<const CheckedRow*> rows;
    std::vector<double> values;
    double value = 0, mesh = 0, off = 0;  ///< means; `off`: what its readings agree on
};

// The median; of an even number, the middle value nearer to the mesh: with two readings, the one
// that is off has the slip.
double agreed(std::vector<double> off) {
    std::sort(off.begin(), off.end());
    const double low = off[(off.size() - 1) / 2], high = off[off.size() / 2];
    return std::abs(low) < std::abs(high) ? low : high;
}

std::vector<TierRead> tiers_read(const std::vector<CheckedRow>& rows,
                                 const std::vector<NamedTier>& tiers) {
    std::vector<TierRead> found;
    for (std::size_t t = 0; t < tiers.size(); ++t) {
        TierRead read{&tiers[t], {}, {}};
        std::vector<double> off;
        for (const CheckedRow& row : rows) {
            if (row.kind != ReadingKind::inclination || row.tier != int(t)) continue;
            read.rows.push_back(&row);
            read.values.push_back(row.value);
            off.push_back(row.off());
            read.value += row.value;
            read.mesh += row.mesh;
        }
        if (off.empty()) continue;
        read.value /= double(off.size());
        read.mesh /= double(off.size());
        read.off = agreed(std::move(off));
        found.push_back(std::move(read));
    }
    return found;
}

// Another tier with the angle that was read here.
const TierRead* whose_value(const TierRead& own, const std::vector<TierRead>& all) {
    for (const TierRead& other : all) {
        const double apart =
            std::min(std::abs(own.value - other.value), std::abs(own.value - other.mesh));
        if (&other != &own && apart < k_alike) return &other;
    }
    return nullptr;
}

// How far the tiers used for comparison are off the mesh.
struct Others {
    double sigma = 0, dof = 0, largest = 0;
    double sigma_of(const TierRead& own) const {
        return std::hypot(sigma, own.rows.front()->sigma);
    }
};

Others others_of(const std::vector<const TierRead*>& tiers, double from_mesh) {
    Others others;
    double squares = k_stated_count * from_mesh * from_mesh;
    for (const TierRead* tier : tiers) {
        squares += tier->off * tier->off;
        others.largest = std::max(others.largest, std::abs(tier->off));
    }
    others.dof = k_stated_count + double(tiers.size());
    others.sigma = std::sqrt(squares / others.dof);
    return others;
}

bool is_far(const TierRead& own, const Others& others, const std::vector<TierRead>& all) {
    const double level = whose_value(own, all) != nullptr ? k_level_of_another : k_tier_level;
    const double strength = std::abs(own.off) / others.sigma_of(own);
    return student_tail(strength, others.dof) * double(all.size()) <= level;
}

std::string what_of(const TierRead& own, const TierRead* source, double others,
                    const std::vector<Reading>& readings) {
    const Reading& first = readings[own.rows.front()->readings.front()];
    const Reading& last = readings[own.rows.back()->readings.front()];
    std::string what = place_words(first);
    if (first.line > 0 && first.line != last.line) {
        what =
            fmt::format("{} lines {} to {}", first.file.filename().string(), first.line, last.line);
    }
    what += fmt::format(
        ": the {} were read {} degrees, {:.1f} {} than the mesh ({:.1f}), where the other tiers "
        "are within {:.1f} of it",
        own.tier->words, range_of(own.values), degrees(std::abs(own.off)),
        own.off > 0 ? "steeper" : "flatter", degrees(own.mesh), degrees(others));
    if (source == nullptr) return what;
    return what + fmt::format("; {:.1f} is the value of the {}, so look whether rows were mixed up",
                              degrees(source->value), source->tier->words);
}

}  // namespace

std::string range_of(const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const std::string low = fmt::format("{:.1f}", degrees(*least)),
                      high = fmt::format("{:.1f}", degrees(*most));
    return low == high ? low : low + " to " + high;
}

void check_tiers(const std::vector<Reading>& readings, const std::vector<CheckedRow>& rows,
                 const std::vector<NamedTier>& tiers, double from_mesh,
                 std::vector<Doubt>& doubts) {
    const std::vector<TierRead> all = tiers_read(rows, tiers);
    if (all.size() <= k_fewest_other_tiers) return;
    std::vector<const TierRead*> farthest_first;
    for (const TierRead& tier : all) farthest_first.push_back(&tier);
    std::stable_sort(
        farthest_first.begin(), farthest_first.end(),
        [](const TierRead* a, const TierRead* b) { return std::abs(a->off) > std::abs(b->off); });
    // With the pavilion's angles in the crown's rows, several tiers are wrong and hide each other.
    // So the least deviating of `count` tiers is compared with those nearer to the mesh, from half
    // of the tiers down (Rosner 1983).
    for (std::size_t count = all.size() / 2; count > 0; --count) {
        const Others others = others_of(
            {farthest_first.begin() + std::ptrdiff_t(count), farthest_first.end()}, from_mesh);
        if (!is_far(*farthest_first[count - 1], others, all)) continue;
        for (std::size_t k = 0; k < count; ++k) {
            const TierRead& own = *farthest_first[k];
            const bool known = std::any_of(doubts.begin(), doubts.end(), [&](const Doubt& d) {
                return d.reading == own.rows.front()->readings.front();
            });
            if (known || !is_far(own, others, all)) continue;
            const std::string what = what_of(own, whose_value(own, all), others.largest, readings);
            const double sigma = others.sigma_of(own), strength = std::abs(own.off) / sigma;
            for (const CheckedRow* row : own.rows) {
                for (const std::size_t i : row->readings) {
                    doubts.push_back({i, row->mesh, sigma, strength, {}, 0, true, what});
                }
            }
        }
        return;
    }
}

}  // namespace culet
