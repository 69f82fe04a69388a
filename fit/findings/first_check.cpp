#include "fit/findings/first_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "fit/findings/blunder.h"
#include "fit/findings/first_check_parts.h"
#include "fit/findings/fitted_parts.h"
#include "fit/readings/slips.h"
#include "stone/units.h"

namespace culet {

namespace {

// Beyond so many sigmas a reading is doubted: of 40 honest readings, normally distributed, one in
// 3 700 sets has one. Stones' own errors have longer tails, so that sigmas are not taken too small.
constexpr double k_doubted = 4.5;
// Where a common slip explains it, less is needed; it has to lead near what was expected.
constexpr double k_doubted_with_slip = 3.5, k_explained = 2;

std::string place_of(const Reading& r) {
    if (r.line <= 0) return "reading " + r.id;
    return fmt::format("{} line {}", r.file.filename().string(), r.line);
}

std::string of_whom(const Reading& r) {
    const bool is_across = r.kind == ReadingKind::width || r.kind == ReadingKind::table_width;
    if (is_across && !r.has_direction) {
        return fmt::format(" at {:.4g} degrees:", degrees(r.azimuth));
    }
    std::string text;
    for (const std::string& name : r.of) text += (text.empty() ? " of " : "/") + name;
    return text;
}

std::string slip_words(const Doubt& doubt, bool in_radians) {
    if (doubt.slip.empty()) return {};
    return fmt::format("; {:g}? ({})", in_radians ? degrees(doubt.corrected) : doubt.corrected,
                       doubt.slip);
}

// The fit without the reading knows better what it should be than the first look did. Of several
// facets the least sure one's sigma is no less than that of their mean.
void ask_the_fit(const Reading& r, const FitResult& result, Doubt& doubt) {
    if (r.kind != ReadingKind::inclination || r.facets.empty() || doubt.of_tier ||
        r.datum.kind != Datum::Kind::up || result.status == FitStatus::not_converged ||
        result.facets.empty()) {
        return;
    }
    double mean = 0, sigma = 0;
    for (const int f : r.facets) {
        const FittedFacet& facet = result.facets[std::size_t(f)];
        mean += facet.inclination / double(r.facets.size());
        sigma = std::max(sigma, facet.sigma_inclination);
    }
    sigma = std::hypot(sigma, r.sigma);
    if (!(sigma < doubt.sigma)) return;
    doubt.expected = mean;
    doubt.sigma = sigma;
    // What the first look let through may be too far now: it may be slips of sigmas, too.
    const auto slip =
        find_slip(degrees(r.value), {degrees(mean), degrees(sigma), degrees(k_doubted * sigma)},
                  Measured::angle);
    doubt.slip = slip ? slip->what : "";
    doubt.corrected = slip ? radians(slip->corrected) : 0;
}

std::string unit_words(ReadingKind kind) {
    if (is_angle(kind)) return " degrees";
    if (kind == ReadingKind::weight) return " ct";
    return "";
}

}  // namespace

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double robust_sigma(const std::vector<double>& values) {
    if (values.size() < 3) return 0;
    const double middle = median(values);
    std::vector<double> off;
    for (const double v : values) off.push_back(std::abs(v - middle));
    return 1.4826 * median(std::move(off));  // of a normal distribution
}

Expected expected_of_sisters(const Row& own, double own_mesh, const std::vector<double>& values,
                             const std::vector<double>& off_mesh, double floor) {
    // The median of n is itself uncertain: pi / 2n of the variance.
    const double widened = std::sqrt(1 + 1.5708 / double(values.size()));
    const auto expected = [&](double value, double scatter) {
        return Expected{value, std::max(floor, scatter) * widened, {}};
    };
    // Facets of a tier are alike, or they differ as they are drawn: whichever the row suits better.
    // So an odd facet of a design is no slip, and a rough drawing of like facets makes none.
    const Expected alike = expected(median(values), robust_sigma(values)),
                   as_drawn = expected(own_mesh + median(off_mesh), robust_sigma(off_mesh));
    const auto strength = [&](const Expected& e) {
        return std::abs(own.value - e.value) / e.sigma;
    };
    return strength(alike) < strength(as_drawn) ? alike : as_drawn;
}

std::vector<Row> rows_of(const std::vector<Reading>& readings,
                         const std::vector<std::size_t>& asked) {
    std::vector<Row> rows;
    std::map<std::pair<std::string, long>, std::size_t> known;
    for (const std::size_t i : asked) {
        const Reading& r = readings[i];
        if (r.line > 0) {
            const auto [at, fresh] = known.try_emplace({r.file.string(), r.line}, rows.size());
            if (!fresh) {
                rows[at->second].readings.push_back(i);
                continue;
            }
        }
        rows.push_back({{i}, r.value, std::hypot(r.sigma, r.rounding / std::sqrt(12.0))});
    }
    return rows;
}

void doubt_if_far(const std::vector<Reading>& readings, const Row& row, const Expected& expected,
                  std::vector<Doubt>& doubts) {
    const Reading& first = readings[row.readings.front()];
    const double sigma = std::hypot(expected.sigma, row.sigma);
    const double off = row.value - expected.value, strength = std::abs(off) / sigma;
    if (!(strength > k_doubted_with_slip)) return;
    const double unit = is_angle(first.kind) ? degrees(1) : 1;
    const std::vector<Slip> slips = find_slips(
        unit * row.value, {unit * expected.value, unit * sigma, unit * k_explained * sigma},
        measured_by(first.kind));
    const bool tells =
        std::any_of(slips.begin(), slips.end(), [](const Slip& slip) { return slip.telling; });
    if (!(strength > k_doubted) && !tells) return;
    Doubt doubt;
    doubt.expected = expected.value;
    doubt.sigma = sigma;
    doubt.strength = strength;
    if (!slips.empty()) {
        doubt.slip = slips.front().what;
        doubt.corrected = slips.front().corrected / unit;
    }
    const std::string by =
        is_angle(first.kind)
            ? fmt::format("{:.1f} degrees from {}", std::abs(unit * off), expected.by)
            : fmt::format("{:.0f} % {} than {}", 100 * std::abs(off) / expected.value,
                          off > 0 ? "more" : "less", expected.by);
    doubt.what = fmt::format("{}: {}{} {:g}{} is {}", place_of(first), name_of(first.kind),
                             of_whom(first), unit * row.value, unit_words(first.kind), by);
    for (const std::size_t i : row.readings) {
        doubt.reading = i;
        doubts.push_back(doubt);
    }
}

std::vector<Doubt> first_check(const Stone& stone, const std::vector<Reading>& readings,
                               bool is_design) {
    std::vector<Doubt> doubts;
    check_angles(stone, readings, is_design, doubts);
    check_lengths(stone, readings, is_design, doubts);
    std::stable_sort(doubts.begin(), doubts.end(),
                     [](const Doubt& a, const Doubt& b) { return a.strength > b.strength; });
    return doubts;
}

void put_back_doubted(const std::vector<Reading>& readings, std::vector<Doubt> doubts,
                      FitResult& result) {
    for (Doubt& d : doubts) ask_the_fit(readings[d.reading], result, d);
    std::vector<const Doubt*> by_place;
    for (const Doubt& d : doubts) by_place.push_back(&d);
    std::sort(by_place.begin(), by_place.end(),
              [](const Doubt* a, const Doubt* b) { return a->reading < b->reading; });
    for (const Doubt* d : by_place) {
        const Reading& r = readings[d->reading];
        FittedReading fitted = as_taken(r);
        fitted.fitted = d->expected;
        fitted.residual = d->expected - r.value;
        fitted.normalized = fitted.residual / d->sigma;
        fitted.redundancy = 1;
        fitted.suspect = true;
        fitted.left_out = "far off what its like say";
        result.readings.insert(result.readings.begin() + std::ptrdiff_t(d->reading),
                               std::move(fitted));
    }
    std::vector<std::string> suspects, words;
    std::vector<Proposal> proposals;
    for (const Doubt& d : doubts) {
        const Reading& r = readings[d.reading];
        suspects.push_back(r.id);
        proposals.push_back({r.id, is_angle(r.kind), d.expected, d.sigma, d.slip, d.corrected, {}});
        const std::string line = d.what + slip_words(d, is_angle(r.kind));
        if (std::find(words.begin(), words.end(), line) == words.end()) words.push_back(line);
    }
    result.findings.suspects.insert(result.findings.suspects.begin(), suspects.begin(),
                                    suspects.end());
    result.findings.proposals.insert(result.findings.proposals.begin(), proposals.begin(),
                                     proposals.end());
    const bool was_good = result.status == FitStatus::converged;
    const std::string before = result.message;
    result.message.clear();
    for (const std::string& line : words) {
        result.message += (result.message.empty() ? "" : "; ") + line;
        result.findings.doubts.push_back(line);
    }
    result.message +=
        words.size() == 1 ? "; the fit does without it" : "; the fit does without them";
    if (!was_good) result.message += "; without: " + before;
    if (result.status != FitStatus::not_converged) result.status = FitStatus::contradictory;
}

}  // namespace culet
