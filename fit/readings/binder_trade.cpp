// Words of the trade: units, a diameter, a table, the angle of the mains, the tooth of an index
// wheel.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "fit/readings/binder.h"
#include "fit/readings/reading_kinds.h"
#include "stone/design/tiers.h"
#include "stone/solid/caliper.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

using Of = WrittenUnit::Of;

// Mains are opposite each other if their directions differ by less.
constexpr double k_opposite_deg = 3;
// Largest ratio of a regular table's widths over opposite corners.
constexpr double k_regular = 1.1;
const char* measure_word(Of measure) {
    switch (measure) {
        case Of::length:
            return "a length";
        case Of::angle:
            return "an angle";
        case Of::weight:
            return "a weight";
        case Of::volume:
            return "a volume";
        case Of::percent:
            return "a percentage";
        case Of::teeth:
            return "a tooth of an index wheel";
        case Of::none:
            break;
    }
    return "a number";
}

std::string example_of(Of measure, LengthUnit unit) {
    switch (measure) {
        case Of::angle:
            return "degrees, such as 34.5 or 34.5 deg";
        case Of::weight:
            return "carats, such as 1.05 or 1.05 ct";
        case Of::volume:
            return "cubic millimetres, such as 78.2 or 78.2 mm3";
        default:
            return fmt::format("a length, such as 6.52 (it counts in {}) or 6.52 mm",
                               name_of(unit));
    }
}

// Directions that differ by more than `k_opposite_deg` modulo 180; degrees in [0, 180).
std::vector<double> distinct_half_turns(std::vector<double> azimuths) {
    for (double& a : azimuths) {
        a = std::fmod(std::fmod(a, 180) + 180, 180);
        if (180 - a < k_opposite_deg / 2) a -= 180;
    }
    std::sort(azimuths.begin(), azimuths.end());
    std::vector<double> distinct;
    for (const double a : azimuths) {
        if (distinct.empty() || a - distinct.back() > k_opposite_deg) distinct.push_back(a);
    }
    return distinct;
}

}  // namespace

double Binder::counted(double number, const WrittenUnit& unit, const char* column,
                       ReadingKind kind) const {
    const bool index = kind_word(written_->kind)->trade == KindWord::Trade::index;
    Of wanted = row_of(kind).measure;
    // The value is a tooth; its sigma is in teeth or degrees.
    if (index) return number;
    if (unit.of == Of::none) return number;
    if (unit.of == Of::percent && wanted == Of::length) {
        fail(
            fmt::format("{} is {:g} {}: a percentage of the width; write the length itself, such "
                        "as 3.78 mm for 58 % of a stone 6.52 mm wide",
                        column, number, unit.word));
    }
    if (unit.of != wanted) {
        fail(fmt::format("{} is {:g} {}, {}; expected {}", column, number, unit.word,
                         measure_word(unit.of), example_of(wanted, stone_.unit)));
    }
    const double scaled = number * unit.factor;
    return wanted == Of::length ? scaled / mm_per(stone_.unit) : scaled;
}

// GemCad's rule: the normal of a facet at tooth i of a wheel of N is 360 i / N degrees clockwise
// from +y seen from above (cut_planes.h), on both sides of the stone. Azimuths run the other way,
// from +x.
void Binder::from_index(Reading& reading) const {
    const WrittenReading& w = *written_;
    if (!w.datum.empty()) fail("takes no datum: teeth are counted on the wheel");
    if (w.value_unit.of == Of::angle) {
        fail(fmt::format("value is {:g} {}; an angle about the stone is an `azimuth`", *w.value,
                         w.value_unit.word));
    }
    if (w.value_unit.of != Of::teeth) {
        fail(fmt::format("value is {:g}; write the wheel's teeth with it, such as {:g} of 96",
                         *w.value, *w.value));
    }
    const double teeth = w.value_unit.factor;
    if (std::abs(*w.value) > std::abs(teeth)) {
        fail(fmt::format("value is {:g} {}; the wheel has no such tooth", *w.value,
                         w.value_unit.word));
    }
    const auto width = [&](const std::optional<double>& number, const WrittenUnit& unit,
                           const char* column) {
        if (!number) return 0.0;
        if (unit.of == Of::angle) return radians(*number);
        if (unit.of != Of::none) {
            fail(fmt::format("{} is {:g} {}; expected teeth (0.1), or degrees (0.4 deg)", column,
                             *number, unit.word));
        }
        return *number * 2 * std::numbers::pi / std::abs(teeth);
    };
    reading.value = std::numbers::pi / 2 - 2 * std::numbers::pi * *w.value / teeth;
    reading.sigma = width(w.sigma, w.sigma_unit, "sigma");
    reading.rounding = width(w.rounding, w.rounding_unit, "rounding");
}

std::vector<Reading> Binder::of_trade(const Reading& base, KindWord::Trade trade) const {
    switch (trade) {
        case KindWord::Trade::diameter:
            return of_diameter(base);
        case KindWord::Trade::table:
            return of_table(base);
        case KindWord::Trade::crown_angle:
            return of_mains(base, true);
        case KindWord::Trade::pavilion_angle:
            return of_mains(base, false);
        default:
            return of_one_facet(base);
    }
}

// The mean of caliper widths across opposite mains: as many widths of that value, together as
// certain as the one reading.
std::vector<Reading> Binder::of_diameter(const Reading& base) const {
    const CaliperWidths widths = caliper_widths(stone_.solid, up_);
    if (!widths.round()) {
        fail(
            fmt::format("the mesh is {:.4g} by {:.4g}: not round, so it has no one diameter; write "
                        "`width` with an azimuth in `of`",
                        widths.length, widths.least));
    }
    const PlanFrame frame = plan_frame(up_);
    std::vector<double> azimuths;
    for (const int f : main_facets(stone_.solid, up_, true)) {
        const Vec3& n = stone_.solid.facets[f].plane.normal;
        azimuths.push_back(degrees(std::atan2(glm::dot(n, frame.y), glm::dot(n, frame.x))));
    }
    azimuths = distinct_half_turns(std::move(azimuths));
    if (azimuths.size() < 2) azimuths = {0, 45, 90, 135};
    std::vector<Reading> readings;
    for (const double a : azimuths) {
        Reading reading = base;
        reading.of = {fmt::format("{:.4g}", a + 0.0)};
        reading.id = base.id + "." + reading.of[0];
        // Along a direction of the mesh, wherever the readings' azimuths begin.
        reading.direction = std::cos(radians(a)) * frame.x + std::sin(radians(a)) * frame.y;
        reading.has_direction = true;
        reading.sigma *= std::sqrt(double(azimuths.size()));
        reading.rounding *= std::sqrt(double(azimuths.size()));
        readings.push_back(std::move(reading));
    }
    note(
        fmt::format("`{}` counts as the mean width across opposite mains: {} widths of that value, "
                    "with the weight of one reading",
                    written_->kind, azimuths.size()));
    return readings;
}

// The mean width from corner to opposite corner.
std::vector<Reading> Binder::of_table(const Reading& base) const {
    const char* const remedy = "; write `table_width` with an azimuth in `of`";
    if (stone_.up_facet.empty()) {
        fail("needs to know the table: set `up` of [stone] to its facet name");
    }
    // Azimuth readings may begin anywhere.
    if (!stone_.azimuth_from_mesh) {
        for (const WrittenReading& w : all_) {
            const auto word = kind_word(w.kind);
            if (w.skipped || !word || word->kind != ReadingKind::azimuth || !w.datum.empty())
                continue;
            fail(fmt::format(
                "azimuths were read (line {}), so that it matters which way the table was "
                "measured{}",
                w.line, remedy));
        }
    }
    const Facet& table = stone_.solid.facets[std::size_t(facet(stone_.up_facet))];
    const PlanFrame frame = plan_frame(up_);
    const std::size_t count = table.corners.size(), half = count / 2;
    double least = 1e300, largest = 0;
    std::vector<double> azimuths;
    for (std::size_t i = 0; i < half && count % 2 == 0; ++i) {
        const Vec3 across = stone_.solid.vertices[table.corners[i + half]] -
                            stone_.solid.vertices[table.corners[i]];
        const double x = glm::dot(across, frame.x), y = glm::dot(across, frame.y);
        least = std::min(least, std::hypot(x, y));
        largest = std::max(largest, std::hypot(x, y));
        azimuths.push_back(degrees(std::atan2(y, x)));
    }
    azimuths = distinct_half_turns(std::move(azimuths));
    if (azimuths.size() < half || half < 3 || largest > k_regular * least) {
        fail(fmt::format("the table of the mesh is not a regular polygon, so it has no one width{}",
                         remedy));
    }
    std::vector<Reading> readings;
    for (const double a : azimuths) {
        Reading reading = base;
        reading.of = {fmt::format("{:.4g}", a + 0.0)};
        reading.id = base.id + "." + reading.of[0];
        reading.azimuth = radians(a);
        reading.sigma *= std::sqrt(double(azimuths.size()));
        reading.rounding *= std::sqrt(double(azimuths.size()));
        readings.push_back(std::move(reading));
    }
    note(
        fmt::format("`{}` counts as the mean from corner to opposite corner: {} table widths of "
                    "that value, with the weight of one reading",
                    written_->kind, azimuths.size()));
    return readings;
}

std::vector<Reading> Binder::of_mains(const Reading& base, bool crown) const {
    Reading reading = base;
    reading.facets = main_facets(stone_.solid, up_, crown);
    if (reading.facets.empty()) {
        fail(fmt::format("the mesh has no {} facets", crown ? "crown" : "pavilion"));
    }
    reading.aggregate = reading.facets.size() > 1 ? Aggregate::mean : Aggregate::single;
    std::string names;
    for (const int f : reading.facets) names += (names.empty() ? "" : "/") + facet_name(f);
    for (const FacetTier& tier : tiers_of(stone_.solid, up_)) {
        if (tier.facets == reading.facets && !tier.pattern.empty()) names = tier.pattern;
    }
    reading.of = {reading.facets.size() > 1 ? "mean(" + names + ")" : names};
    note(fmt::format("`{}` is the mean inclination of {}", written_->kind,
                     reading.facets.size() > 1 ? names : reading.of[0]));
    return {reading};
}

}  // namespace culet
