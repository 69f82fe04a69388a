#include "fit/findings/tier_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "fit/readings/named_tiers.h"
#include "fit/uncertainty/statistics.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

// Chance produces a finding once in a hundred tiers.
constexpr double k_split_level = 0.01;
constexpr std::size_t k_fewest = 3;

struct Read {
    int facet = -1;
    double value = 0;  ///< inclination
    double off = 0;    ///< from the design, or from nothing
    double drawn = 0;  ///< inclination in the mesh
    double weight = 0;
};

struct Mean {
    double value = 0, weight = 0;
    void add(double x, double w) {
        value = (value * weight + x * w) / (weight + w);
        weight += w;
    }
    double sigma() const { return 1 / std::sqrt(weight); }
};

Mean mean_of(const std::vector<Read>& reads, std::size_t from, std::size_t to) {
    Mean mean;
    for (std::size_t i = from; i < to; ++i) mean.add(reads[i].off, reads[i].weight);
    return mean;
}

double log_choices(std::size_t n, std::size_t k) {
    return std::lgamma(double(n + 1)) - std::lgamma(double(k + 1)) - std::lgamma(double(n - k + 1));
}

struct Split {
    std::size_t from = 0, to = 0;  ///< range of the sorted list that stands out
    double off = 0, sigma = 0, p = 1;
};

// The likeliest few at either end of a list sorted by `off`.
Split best_split(const std::vector<Read>& reads, std::size_t most) {
    Split best;
    const std::size_t n = reads.size();
    for (std::size_t k = 1; k <= most; ++k) {
        for (const bool upper : {true, false}) {
            const std::size_t from = upper ? n - k : 0, to = upper ? n : k;
            const Mean few = mean_of(reads, from, to);
            const Mean rest = upper ? mean_of(reads, 0, from) : mean_of(reads, to, n);
            const double off = few.value - rest.value;
            const double sigma = std::hypot(few.sigma(), rest.sigma());
            // Counts both ends and every choice of k.
            const double tail = chi2_tail(off * off / (sigma * sigma), 1);
            const double p = std::min(1.0, tail * std::exp(log_choices(n, k)));
            if (p < best.p) best = {from, to, off, sigma, p};
        }
    }
    return best;
}

std::string all_of_them(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    }
    return text;
}

std::vector<Read> reads_of(const NamedTier& tier, const Stone& stone,
                           const std::vector<Reading>& readings,
                           const std::vector<std::string>& left_out, const Vec3& up,
                           bool is_design) {
    std::map<int, Mean> by_facet;
    std::map<std::pair<std::string, long>, int> rows;
    for (const Reading& r : readings) {
        if (r.kind == ReadingKind::inclination && r.line > 0) ++rows[{r.file.string(), r.line}];
    }
    for (const Reading& r : readings) {
        const double sigma = std::hypot(r.sigma, r.rounding / std::sqrt(12.0));
        if (r.kind != ReadingKind::inclination || r.aggregate != Aggregate::single || r.exact ||
            r.facets.size() != 1 || r.datum.kind != Datum::Kind::up || !(sigma > 0) ||
            std::find(left_out.begin(), left_out.end(), r.id) != left_out.end() ||
            std::find(tier.facets.begin(), tier.facets.end(), r.facets[0]) == tier.facets.end()) {
            continue;
        }
        // One value for a whole tier does not distinguish its facets.
        if (r.line > 0 && rows[{r.file.string(), r.line}] > 1) continue;
        by_facet[r.facets[0]].add(r.value, 1 / (sigma * sigma));
    }
    std::vector<Read> reads;
    for (const auto& [facet, mean] : by_facet) {
        const Vec3& n = stone.solid.facets[std::size_t(facet)].plane.normal;
        const double drawn = inclination(n, up);
        reads.push_back(
            {facet, mean.value, mean.value - (is_design ? drawn : 0), drawn, mean.weight});
    }
    return reads;
}

std::string sentence_of(const NamedTierFinding& tier, const OddFacets& odd) {
    const bool one = odd.facets.size() == 1;
    const double off = degrees(std::abs(odd.off)), sigma = degrees(odd.sigma);
    const int digits = sigma < 0.05 ? 2 : 1;
    return fmt::format("{} {} {:.{}f} ± {:.{}f} degrees {} than the other {}",
                       all_of_them(odd.facets), one ? "is" : "are", off, digits, sigma, digits,
                       odd.off > 0 ? "steeper" : "flatter", tier.words);
}

// True if these were drawn to be like the others: the mesh lacks the difference that was read
// (beyond its scatter, and nearer to it than to none), and is fine enough to show one, unless a
// name confirms the tier.
bool were_meant_alike(const std::vector<Read>& reads, const Split& split, const NamedTier& tier) {
    constexpr double k_surely = 2;
    Mean few, rest, few_read, rest_read;
    for (std::size_t i = 0; i < reads.size(); ++i) {
        const bool odd = i >= split.from && i < split.to;
        (odd ? few : rest).add(reads[i].drawn, 1);
        (odd ? few_read : rest_read).add(reads[i].value, 1);
    }
    const double drawn = few.value - rest.value, read = few_read.value - rest_read.value;
    const double limit = k_surely * tier.scatter * std::hypot(few.sigma(), rest.sigma());
    if (std::abs(drawn) > limit && std::abs(read - drawn) < std::abs(drawn)) return false;
    return tier.named || std::abs(read - drawn) > limit;
}

void find_odd(const Stone& stone, std::vector<Read> reads, const NamedTier& tier,
              NamedTierFinding& finding) {
    std::sort(reads.begin(), reads.end(),
              [](const Read& a, const Read& b) { return a.off < b.off; });
    // Fewer than half may stand out, else it is unclear from what.
    std::size_t left = (reads.size() - 1) / 2;
    while (left > 0 && reads.size() >= k_fewest) {
        const Split split = best_split(reads, left);
        if (!(split.p < k_split_level) || !were_meant_alike(reads, split, tier)) break;
        OddFacets odd;
        std::vector<int> facets;
        for (std::size_t i = split.from; i < split.to; ++i) facets.push_back(reads[i].facet);
        std::sort(facets.begin(), facets.end());
        for (const int f : facets) odd.facets.push_back(stone.solid.facets[std::size_t(f)].name);
        odd.off = split.off;
        odd.sigma = split.sigma;
        odd.p = split.p;
        left -= split.to - split.from;
        reads.erase(reads.begin() + std::ptrdiff_t(split.from),
                    reads.begin() + std::ptrdiff_t(split.to));
        finding.odd.push_back(std::move(odd));
    }
    Mean common;
    for (const Read& r : reads) common.add(r.value, r.weight);
    finding.common = common.value;
    finding.sigma = common.sigma();
}

}  // namespace

std::vector<NamedTierFinding> tier_findings(const Stone& stone,
                                            const std::vector<Reading>& readings,
                                            const std::vector<std::string>& left_out,
                                            bool is_design) {
    const int table = find_facet(stone.solid, stone.up_facet);
    const Vec3 up =
        table >= 0 ? stone.solid.facets[std::size_t(table)].plane.normal : glm::normalize(stone.up);
    std::vector<NamedTierFinding> findings;
    for (const NamedTier& tier : named_tiers(stone.solid, up)) {
        const std::vector<Read> reads = reads_of(tier, stone, readings, left_out, up, is_design);
        if (reads.empty()) continue;
        NamedTierFinding finding;
        finding.name = tier.name;
        finding.words = tier.words;
        finding.facets = int(tier.facets.size());
        finding.read = int(reads.size());
        const auto [least, most] =
            std::minmax_element(reads.begin(), reads.end(),
                                [](const Read& a, const Read& b) { return a.value < b.value; });
        finding.spread = most->value - least->value;
        find_odd(stone, reads, tier, finding);
        for (const OddFacets& odd : finding.odd) finding.what.push_back(sentence_of(finding, odd));
        findings.push_back(std::move(finding));
    }
    return findings;
}

}  // namespace culet
