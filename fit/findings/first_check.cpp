#include "fit/findings/first_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "fit/findings/blunder.h"
#include "fit/findings/first_check_rows.h"
#include "fit/findings/words.h"
#include "fit/readings/slips.h"

namespace culet {

namespace {

using Kind = ReadingKind;

// Sigmas that make a reading doubtful. One of 3 700 sets of 40 correct readings with normal errors
// has one; tolerances are wide, since real errors have longer tails.
constexpr double k_doubted = 4.5;
// The same with a common slip that leads to within `k_explained` sigmas of the expected value.
constexpr double k_doubted_with_slip = 3.5, k_explained = 2;
// Two others that differ do not tell which of them is wrong.
constexpr std::size_t k_fewest_others = 2;

// How much correct readings differ (docs/measuring.md): radians, and logarithms of lengths; more
// beside a mesh drawn by hand.
struct Tolerances {
    explicit Tolerances(bool is_design) : from_mesh(radians(is_design ? 1 : 3)) {
        if (is_design) return;
        for (double* length : {&widths, &tables, &depth, &table, &volume, &lengths}) *length *= 4;
    }
    double from_mesh, azimuths = radians(1), sisters = radians(0.3);
    double widths = 0.007, tables = 0.01, depth = 0.03, table = 0.04, volume = 0.06, lengths = 0.04;
};

// Expected value and sigma of a row, and their origin in words.
struct Expected {
    double value = 0, sigma = 0;
    std::string by;
};

// From the median of others, whose own variance is pi / 2n of theirs.
Expected beside(const std::vector<double>& others, double tolerance) {
    const double sigma = std::max(tolerance, robust_sigma(others));
    return {median(others), sigma * std::sqrt(1 + 1.5708 / double(others.size())), {}};
}

std::string count_words(std::size_t n) {
    static constexpr std::array words{"no",    "one",   "two",  "three", "four",   "five",  "six",
                                      "seven", "eight", "nine", "ten",   "eleven", "twelve"};
    return n < words.size() ? words[n] : std::to_string(n);
}

class FirstCheck {
public:
    FirstCheck(const Stone& stone, const std::vector<Reading>& readings, bool is_design)
        : readings_(readings), honest_(is_design) {
        const int table = find_facet(stone.solid, stone.up_facet);
        const Vec3 up = table >= 0 ? stone.solid.facets[std::size_t(table)].plane.normal
                                   : glm::normalize(stone.up);
        tiers_ = named_tiers(stone.solid, up);
        rows_ = checked_rows(stone, readings, up, tiers_);
    }
    std::vector<Doubt> doubts();

private:
    std::optional<Expected> expected(const CheckedRow& own) const;
    Expected inclination_of(const CheckedRow& own) const;
    std::optional<Expected> length_of(const CheckedRow& own) const;
    std::optional<Expected> size_of(const CheckedRow& own) const;
    bool is_doubted(const CheckedRow& row) const;
    template <typename Which>
    std::vector<double> off(const Which& which) const;
    void doubt_if_far(const CheckedRow& row, const Expected& expected);

    const std::vector<Reading>& readings_;
    Tolerances honest_;
    std::vector<NamedTier> tiers_;
    std::vector<CheckedRow> rows_;
    std::vector<Doubt> doubts_;
};

template <typename Which>
std::vector<double> FirstCheck::off(const Which& which) const {
    std::vector<double> all;
    for (const CheckedRow& row : rows_) {
        if (which(row)) all.push_back(row.off());
    }
    return all;
}

bool is_size(Kind kind) {
    return kind == Kind::weight || kind == Kind::volume;
}

std::optional<Expected> FirstCheck::expected(const CheckedRow& own) const {
    if (own.kind == Kind::inclination) return inclination_of(own);
    if (is_size(own.kind)) return size_of(own);
    if (own.kind != Kind::azimuth) return length_of(own);
    const double scatter = robust_sigma(off([](const auto& r) { return r.kind == Kind::azimuth; }));
    return Expected{
        own.mesh, std::max(honest_.azimuths, scatter),
        fmt::format("where the other azimuths put this facet ({:.1f})", degrees(own.mesh))};
}

Expected FirstCheck::inclination_of(const CheckedRow& own) const {
    const auto is_sister = [&](const CheckedRow& r) {
        return r.kind == Kind::inclination && r.tier >= 0 && r.tier == own.tier && own.facet >= 0 &&
               r.facet >= 0 && r.facet != own.facet;
    };
    const std::vector<double> off_mesh = off(is_sister);
    if (off_mesh.size() < k_fewest_others) {
        const double scatter = robust_sigma(
            off([](const auto& r) { return r.kind == Kind::inclination && r.facet >= 0; }));
        return {own.mesh, std::max(honest_.from_mesh, scatter),
                fmt::format("the mesh ({:.1f})", degrees(own.mesh))};
    }
    std::vector<double> values;
    for (const CheckedRow& r : rows_) {
        if (is_sister(r)) values.push_back(r.value);
    }
    // Facets of a tier are equal or differ as drawn, whichever suits the row: so an odd facet of a
    // design is no slip, and a rough drawing of equal facets makes none.
    const Expected alike = beside(values, honest_.sisters);
    Expected as_drawn = beside(off_mesh, honest_.sisters);
    as_drawn.value = own.at(as_drawn.value);
    const auto strength = [&](const Expected& e) {
        return std::abs(own.value - e.value) / e.sigma;
    };
    Expected expected = strength(alike) < strength(as_drawn) ? alike : as_drawn;
    expected.by = fmt::format("its {} sisters ({})", count_words(values.size()), range_of(values));
    return expected;
}

std::optional<Expected> FirstCheck::length_of(const CheckedRow& own) const {
    const auto is_other = [&](const CheckedRow& r) {
        return &r != &own && !(r.line > 0 && r.line == own.line) && !is_angle(r.kind);
    };
    const auto say = [&](const std::vector<double>& others, double tolerance, const char* who) {
        Expected e = beside(others, tolerance);
        e.value = own.at(e.value);
        e.sigma *= e.value;
        e.by = fmt::format("{} say ({:.4g})", who, e.value);
        return e;
    };
    const auto widths = off([](const CheckedRow& r) { return r.kind == Kind::width; });
    if (widths.size() <= k_fewest_others) {
        // If two differ, either may be wrong. The volume grows with the cube of lengths.
        auto others = off([&](const auto& r) { return is_other(r) && !is_size(r.kind); });
        const auto sizes = off([](const auto& r) { return is_size(r.kind); });
        if (!sizes.empty()) others.push_back(sizes.front() / 3);
        if (others.size() <= k_fewest_others) return std::nullopt;
        return say(others, honest_.lengths, "the other lengths and the mesh");
    }
    const auto like = off([&](const auto& r) { return is_other(r) && r.kind == own.kind; });
    const bool checked_by_like = own.kind != Kind::depth && like.size() >= k_fewest_others;
    if (own.kind == Kind::width) {
        if (!checked_by_like) return std::nullopt;
        return say(like, honest_.widths, "the other widths");
    }
    if (checked_by_like) return say(like, honest_.tables, "the other table widths");
    return say(widths, own.kind == Kind::depth ? honest_.depth : honest_.table,
               "the widths and the mesh");
}

// Doubted lengths are not used.
std::optional<Expected> FirstCheck::size_of(const CheckedRow& own) const {
    const auto believed = [&](Kind kind) {
        return off([&](const CheckedRow& r) { return r.kind == kind && !is_doubted(r); });
    };
    const std::vector<double> widths = believed(Kind::width), depths = believed(Kind::depth);
    if (widths.empty()) return std::nullopt;
    const double value = own.at(2 * median(widths) + median(depths.empty() ? widths : depths));
    return Expected{value, honest_.volume * value,
                    fmt::format("a stone of these widths and this depth {} ({:.4g})",
                                own.kind == Kind::weight ? "weighs" : "has", value)};
}

bool FirstCheck::is_doubted(const CheckedRow& row) const {
    return std::any_of(doubts_.begin(), doubts_.end(),
                       [&](const Doubt& d) { return d.reading == row.readings.front(); });
}

std::string named(const Reading& r, double value) {
    const bool is_across = r.kind == Kind::width || r.kind == Kind::table_width;
    const std::string of = is_across && !r.has_direction
                               ? fmt::format(" at {:.4g} degrees:", degrees(r.azimuth))
                               : of_words(r.of);
    return fmt::format("{}: {}{} {:g}{}", place_words(r), name_of(r.kind), of, value,
                       is_angle(r.kind)         ? " degrees"
                       : r.kind == Kind::weight ? " ct"
                                                : "");
}

void FirstCheck::doubt_if_far(const CheckedRow& row, const Expected& expected) {
    const double sigma = std::hypot(expected.sigma, row.sigma);
    const double off = row.value - expected.value, strength = std::abs(off) / sigma;
    if (!(strength > k_doubted_with_slip)) return;
    const double unit = file_unit(row.kind);
    const std::vector<Slip> slips = find_slips(
        unit * row.value, {unit * expected.value, unit * sigma, unit * k_explained * sigma},
        measured_by(row.kind));
    const bool tells =
        std::any_of(slips.begin(), slips.end(), [](const Slip& slip) { return slip.telling; });
    if (!(strength > k_doubted) && !tells) return;
    Doubt doubt{0, expected.value, sigma, strength, {}, 0, false, {}};
    if (!slips.empty()) {
        doubt.slip = slips.front().what;
        doubt.corrected = slips.front().corrected / unit;
    }
    doubt.what = fmt::format(
        "{} is {} {}", named(readings_[row.readings.front()], unit * row.value),
        is_angle(row.kind) ? fmt::format("{:.1f} degrees from", std::abs(unit * off))
                           : fmt::format("{:.0f} % {} than", 100 * std::abs(off) / expected.value,
                                         off > 0 ? "more" : "less"),
        expected.by);
    for (const std::size_t i : row.readings) {
        doubt.reading = i;
        doubts_.push_back(doubt);
    }
}

std::vector<Doubt> FirstCheck::doubts() {
    for (const bool sizes : {false, true}) {
        for (const CheckedRow& row : rows_) {
            if (is_size(row.kind) != sizes) continue;
            if (const auto e = expected(row)) doubt_if_far(row, *e);
        }
    }
    check_tiers(readings_, rows_, tiers_, honest_.from_mesh, doubts_);
    std::stable_sort(doubts_.begin(), doubts_.end(),
                     [](const Doubt& a, const Doubt& b) { return a.strength > b.strength; });
    return std::move(doubts_);
}

// The fit without the reading knows its value better. The largest sigma of several facets is an
// upper limit of that of their mean.
Proposal ask_the_fit(const Reading& r, const FitResult& result, const Doubt& doubt) {
    const Proposal first{
        r.id, is_angle(r.kind), doubt.expected, doubt.sigma, doubt.slip, doubt.corrected, {}};
    if (r.kind != Kind::inclination || r.facets.empty() || doubt.of_tier ||
        r.datum.kind != Datum::Kind::up || result.status == FitStatus::not_converged ||
        result.facets.empty()) {
        return first;
    }
    double mean = 0, sigma = 0;
    for (const int f : r.facets) {
        const FittedFacet& facet = result.facets[std::size_t(f)];
        mean += facet.inclination / double(r.facets.size());
        sigma = std::max(sigma, facet.sigma_inclination);
    }
    return std::hypot(sigma, r.sigma) < doubt.sigma ? proposal_for(r, mean, sigma) : first;
}

}  // namespace

std::vector<Doubt> first_check(const Stone& stone, const std::vector<Reading>& readings,
                               bool is_design) {
    return FirstCheck(stone, readings, is_design).doubts();
}

void restore_doubted(const std::vector<Reading>& readings, std::vector<Doubt> doubts,
                     FitResult& result) {
    std::vector<Proposal> proposals;
    std::vector<std::pair<std::size_t, FittedReading>> by_place;
    std::string told;
    std::vector<std::string>& words = result.findings.doubts;
    for (const Doubt& d : doubts) {
        const Reading& r = readings[d.reading];
        proposals.push_back(ask_the_fit(r, result, d));
        by_place.emplace_back(d.reading,
                              left_out(r, proposals.back(), "far from similar readings"));
        const std::string line = d.what + slip_words(proposals.back());
        if (std::find(words.begin(), words.end(), line) != words.end()) continue;
        words.push_back(line);
        told += line + "; ";
    }
    std::sort(by_place.begin(), by_place.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [at, fitted] : by_place) {
        result.readings.insert(result.readings.begin() + std::ptrdiff_t(at), std::move(fitted));
    }
    accuse(proposals, told + (words.size() == 1 ? "it was left out" : "they were left out"),
           result);
}

}  // namespace culet
