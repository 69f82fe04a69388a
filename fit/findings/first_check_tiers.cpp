// Tiers beside each other: one that is off the mesh as a whole. Its readings agree with each other,
// so that none is odd by itself.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/findings/first_check_parts.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

namespace {

// Of all tiers of a set; more than for one reading, since a tier is rarely typed wrong. The value
// of another tier comes within what facets of a tier differ by (0.3 degrees either way) of one
// angle in eight by chance, where six tiers share 30 degrees: beside one the rest may be likelier.
constexpr double k_tier_level = 0.001, k_level_of_another = 0.008;
constexpr double k_alike_deg = 0.3;
// Of so many other tiers one learns how far tiers of this stone are off the mesh.
constexpr std::size_t k_fewest_others = 2;
// What is expected of them counts for one observation, as in the prior.
constexpr double k_stated_count = 1;

struct TierRead {
    std::size_t tier = 0;
    std::vector<const ReadAngle*> angles;
    double value = 0, mesh = 0, off = 0;  ///< means; the median of what each is off
};

std::vector<TierRead> tiers_read(const std::vector<ReadAngle>& angles,
                                 const std::vector<int>& tier_of, std::size_t count) {
    std::vector<TierRead> found;
    for (std::size_t t = 0; t < count; ++t) {
        TierRead read;
        read.tier = t;
        std::vector<double> off;
        for (const ReadAngle& angle : angles) {
            if (tier_of[std::size_t(angle.facet)] != int(t)) continue;
            read.angles.push_back(&angle);
            off.push_back(angle.off());
            read.value += angle.row.value;
            read.mesh += angle.mesh;
        }
        if (off.empty()) continue;
        read.value /= double(off.size());
        read.mesh /= double(off.size());
        read.off = median(std::move(off));
        found.push_back(std::move(read));
    }
    return found;
}

// Another tier whose angle this one's readings are.
const TierRead* whose_value(const TierRead& own, const std::vector<TierRead>& all) {
    for (const TierRead& other : all) {
        const double apart =
            std::min(std::abs(own.value - other.value), std::abs(own.value - other.mesh));
        if (&other != &own && apart < radians(k_alike_deg)) return &other;
    }
    return nullptr;
}

std::string lines_of(const TierRead& tier, const std::vector<Reading>& readings) {
    const Reading& first = readings[tier.angles.front()->row.readings.front()];
    const Reading& last = readings[tier.angles.back()->row.readings.front()];
    if (first.line <= 0) return "reading " + first.id;
    if (first.line == last.line) {
        return fmt::format("{} line {}", first.file.filename().string(), first.line);
    }
    return fmt::format("{} lines {} to {}", first.file.filename().string(), first.line, last.line);
}

Doubt doubt_of(const TierRead& own, const TierRead* source, double sigma, double others,
               const std::vector<NamedTier>& tiers, const std::vector<Reading>& readings) {
    std::vector<double> values;
    for (const ReadAngle* angle : own.angles) values.push_back(angle->row.value);
    Doubt doubt;
    doubt.of_tier = true;
    doubt.sigma = sigma;
    doubt.strength = std::abs(own.off) / sigma;
    doubt.what = fmt::format(
        "{}: the {} were read {} degrees, {:.1f} {} than the mesh ({:.1f}), where the other tiers "
        "are within {:.1f} of it",
        lines_of(own, readings), tiers[own.tier].words, range_of(values),
        degrees(std::abs(own.off)), own.off > 0 ? "steeper" : "flatter", degrees(own.mesh),
        degrees(others));
    if (source != nullptr) {
        doubt.what +=
            fmt::format("; {:.1f} is the value of the {}, so look whether rows were mixed up",
                        degrees(source->value), tiers[source->tier].words);
    }
    return doubt;
}

}  // namespace

void check_tiers(const std::vector<Reading>& readings, const std::vector<ReadAngle>& angles,
                 const std::vector<int>& tier_of, const std::vector<NamedTier>& tiers,
                 double from_mesh, std::vector<Doubt>& doubts) {
    const std::vector<TierRead> all = tiers_read(angles, tier_of, tiers.size());
    if (all.size() <= k_fewest_others) return;
    for (const TierRead& own : all) {
        double squares = k_stated_count * from_mesh * from_mesh, largest = 0;
        for (const TierRead& other : all) {
            if (&other == &own) continue;
            squares += other.off * other.off;
            largest = std::max(largest, std::abs(other.off));
        }
        const double dof = k_stated_count + double(all.size() - 1);
        const double sigma = std::hypot(std::sqrt(squares / dof), own.angles.front()->row.sigma);
        const TierRead* source = whose_value(own, all);
        const double level = source != nullptr ? k_level_of_another : k_tier_level;
        if (student_tail(std::abs(own.off) / sigma, dof) * double(all.size()) > level) continue;
        const bool known = std::any_of(doubts.begin(), doubts.end(), [&](const Doubt& d) {
            return d.reading == own.angles.front()->row.readings.front();
        });
        if (known) continue;
        Doubt doubt = doubt_of(own, source, sigma, largest, tiers, readings);
        for (const ReadAngle* angle : own.angles) {
            doubt.expected = angle->mesh;
            for (const std::size_t i : angle->row.readings) {
                doubt.reading = i;
                doubts.push_back(doubt);
            }
        }
    }
}

}  // namespace culet
