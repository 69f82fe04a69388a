#include "fit/readings/binder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "fit/readings/reading_kinds.h"
#include "fit/readings/slips.h"
#include "stone/design/tiers.h"
#include "stone/text/errors.h"
#include "stone/upright.h"

namespace culet {

namespace {

// Hand-made meshes are rarely further off.
constexpr double k_slip_tolerance_deg = 12;

}  // namespace

std::optional<double> plain_number(std::string_view text) {
    double value = 0;
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

Binder::Binder(const Stone& stone, const std::vector<WrittenReading>& all)
    : stone_(stone), all_(all), up_(up_of(stone)) {
    for (std::size_t i = 0; i < stone.solid.facets.size(); ++i) {
        facet_of_name_.emplace(stone.solid.facets[i].name, static_cast<int>(i));
    }
    tier_of_ = tier_names_of(stone.solid, up_);
}

std::vector<Reading> Binder::bind(const WrittenReading& written, const std::string& id) {
    written_ = &written;
    const auto word = kind_word(written.kind);
    if (!word) refuse_kind();
    const ReadingKind kind = word->kind;
    if (written.skipped) return {};
    Reading base;
    base.id = id;
    base.kind = kind;
    base.exact = written.exact;
    base.released = written.released;
    base.note = written.note;
    base.file = written.file;
    base.line = written.line;
    set_value(base);
    if (word->trade == KindWord::Trade::index) from_index(base);
    base.datum = datum(kind);
    if (word->trade != KindWord::Trade::none && written.of.empty()) {
        return of_trade(base, word->trade);
    }
    switch (row_of(kind).of) {
        case Named::one_facet:
            return of_one_facet(base);
        case Named::two_facets:
            return of_two_facets(base);
        case Named::two_places:
            return {of_two_places(base)};
        case Named::direction:
            return {along_direction(base)};
        case Named::whole_stone:
            return {of_whole_stone(base)};
        case Named::many_facets:
            return {of_many_facets(base)};
        case Named::symmetry:
            return {of_symmetry(base)};
        case Named::unwritten:
            if (written.seen_line) return {of_line(base)};
            break;
    }
    fail("unknown kind");
}

void Binder::fail(const std::string& what) const {
    const std::string who =
        written_->id.empty() ? written_->kind : written_->kind + " '" + written_->id + "'";
    throw InputError(written_->file, written_->line, who + ": " + what);
}

void Binder::refuse_kind() const {
    const auto near = near_kind_word(written_->kind);
    throw InputError(written_->file, written_->line,
                     fmt::format("unknown kind of reading '{}'{}; known are {}", written_->kind,
                                 near ? fmt::format(" (did you mean {}?)", *near) : std::string(),
                                 fmt::join(written_kinds(), ", ")));
}

void Binder::set_value(Reading& reading) const {
    const WrittenReading& w = *written_;
    if (w.released && reading.kind != ReadingKind::meet) fail("only a meet can be released");
    if (is_relation(reading.kind)) {
        if (w.value) fail("has no value; leave it empty and give sigma or exact = true");
    } else if (!w.value) {
        fail("value is missing");
    } else {
        if (!std::isfinite(*w.value)) fail("value is not a finite number");
        reading.value = counted(*w.value, w.value_unit, "value", reading.kind);
    }
    if (w.rounding) {
        if (!(*w.rounding > 0) || !std::isfinite(*w.rounding)) {
            fail(
                fmt::format("rounding is {:g}; it must be positive (the step of the "
                            "instrument's display, such as 0.1)",
                            *w.rounding));
        }
        if (is_relation(reading.kind)) fail("takes no rounding: it has no value");
        reading.rounding = counted(*w.rounding, w.rounding_unit, "rounding", reading.kind);
    }
    if (w.sigma) {
        if (!std::isfinite(*w.sigma)) fail("sigma is not a finite number");
        if (!(*w.sigma > 0)) {
            fail(
                fmt::format("sigma is {:g}; it must be positive (one standard uncertainty), or "
                            "give exact = true",
                            *w.sigma));
        }
        reading.sigma = counted(*w.sigma, w.sigma_unit, "sigma", reading.kind);
    } else if (!w.exact && !w.released && reading.kind != ReadingKind::meet && !w.rounding) {
        fail("sigma is missing (one standard uncertainty), or give exact = true");
    }
    if (w.exact && w.released) fail("cannot be exact and released");
    set_side(reading);
    if (kind_word(w.kind)->trade != KindWord::Trade::index) refuse_value(reading);
    if (row_of(reading.kind).measure == WrittenUnit::Of::angle) {
        reading.value = radians(reading.value);
        reading.sigma = radians(reading.sigma);
        reading.rounding = radians(reading.rounding);
    }
}

// In degrees. A value over 90 counts from up all the way: 139 is 41 on the pavilion side.
void Binder::set_side(Reading& reading) const {
    const std::string& side = written_->side;
    if (side.empty() && !(reading.value > 90)) return;
    const bool from_up = reading.kind == ReadingKind::inclination && written_->datum.empty();
    if (!from_up) {
        if (!side.empty()) fail("side is for inclinations measured from up");
        return;
    }
    if (!side.empty() && side != "crown" && side != "pavilion") {
        fail(fmt::format("side is '{}'; it is crown or pavilion", side));
    }
    reading.side = side == "pavilion" || (side.empty() && reading.value > 90) ? -1 : 1;
    if (reading.value > 90 && reading.value <= 180 && side != "crown") {
        reading.value = 180 - reading.value;
    }
}

// In degrees.
void Binder::refuse_value(const Reading& reading) const {
    const double v = reading.value;
    switch (reading.kind) {
        case ReadingKind::inclination: {
            // A girdle facet may lean the other way by the instrument's error.
            const double over =
                reading.side == 0 ? 0 : std::min(3 * reading.sigma, k_over_upright_deg);
            if (v < 0 || v > 90 + over) refuse_inclination(v);
            break;
        }
        case ReadingKind::azimuth:
            if (v < -360 || v > 360) {
                fail(fmt::format("value {:g} is outside -360..360 degrees (a turn less: {:g}?)", v,
                                 std::fmod(v, 360)));
            }
            break;
        case ReadingKind::dihedral:
            if (v <= 0 || v >= (stone_.convex ? 180 : 360)) {
                fail(fmt::format("value {:g} is outside 0..180 degrees (interior angle)", v));
            }
            break;
        case ReadingKind::distance:
            if (v < 0) fail(fmt::format("value {:g} is a negative length", v));
            break;
        default:
            if (!is_relation(reading.kind) && !(v > 0)) {
                fail(fmt::format("value {:g} must be positive", v));
            }
            break;
    }
}

// Suggests the slip that leads near the mesh's inclination.
void Binder::refuse_inclination(double v) const {
    fail(
        fmt::format("value {:g} is outside 0..90 degrees{}; measure pavilion facets from the "
                    "horizontal too, or from up (over 90)",
                    v, meant_inclination(v)));
}

std::string Binder::meant_inclination(double value) const {
    if (written_->of.size() != 1) return {};
    const auto found = facet_of_name_.find(written_->of[0]);
    if (found == facet_of_name_.end()) return {};
    const Vec3& normal = stone_.solid.facets[std::size_t(found->second)].plane.normal;
    const auto slip = find_slip(
        value, {degrees(inclination(normal, up_)), k_slip_tolerance_deg / 3, k_slip_tolerance_deg},
        Measured::angle);
    return slip ? fmt::format(" ({}: {:g}?)", slip->what, slip->corrected) : std::string();
}

Datum Binder::datum(ReadingKind kind) const {
    const std::string& name = written_->datum;
    if (name.empty() || name == "table" || name == "up") return {};
    if (!is_angle(kind) || kind == ReadingKind::dihedral) {
        fail("takes no datum; only inclinations and azimuths are measured from something");
    }
    const bool known_facet = facet_of_name_.count(name) > 0;
    if (kind == ReadingKind::inclination && !known_facet) {
        if (name == "axis") return {Datum::Kind::axis, -1};
        if (name == "girdle") return {Datum::Kind::girdle, -1};
    }
    if (kind == ReadingKind::azimuth && name == stone_.up_facet) {
        fail("the facet that `up` names has no azimuth to count from");
    }
    return {Datum::Kind::facet, facet(name)};
}

}  // namespace culet
