// Finds what readings name on a solid, and refuses what cannot be meant.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

#include "fit/measurement.h"
#include "fit/slips.h"
#include "stone/errors.h"
#include "stone/toml_file.h"

namespace culet {

namespace {

std::string near_names(const Solid& solid, const std::string& name) {
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const Facet& facet : solid.facets) {
        near.emplace_back(edit_distance(name.substr(0, 64), facet.name.substr(0, 64)), facet.name);
    }
    std::stable_sort(near.begin(), near.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(3, near.size()); ++i) {
        text += (i == 0 ? "" : ", ") + near[i].second;
    }
    return text;
}

// `*` stands for any run of characters.
bool matches(std::string_view pattern, std::string_view name) {
    std::size_t p = 0, n = 0, star = std::string_view::npos, resume = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            resume = n;
        } else if (p < pattern.size() && pattern[p] == name[n]) {
            ++p;
            ++n;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            n = ++resume;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

std::optional<double> plain_number(std::string_view text) {
    double value = 0;
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

// A hand-made mesh's inclinations are hardly further off.
constexpr double k_slip_tolerance_deg = 12;

struct NamedFacets {
    Aggregate aggregate = Aggregate::single;
    bool is_pattern = false;
    std::vector<int> facets;
};

class Binder {
public:
    explicit Binder(const Stone& stone) : stone_(stone) {
        for (std::size_t i = 0; i < stone.solid.facets.size(); ++i) {
            facet_of_name_.emplace(stone.solid.facets[i].name, static_cast<int>(i));
        }
    }

    std::vector<Reading> bind(const WrittenReading& written, const std::string& id) {
        written_ = &written;
        const auto kind = reading_kind(written.kind);
        if (!kind) refuse_kind();
        Reading base;
        base.id = id;
        base.kind = *kind;
        base.exact = written.exact;
        base.released = written.released;
        base.note = written.note;
        base.file = written.file;
        base.line = written.line;
        set_value(base);
        base.datum = datum(*kind);
        switch (*kind) {
            case ReadingKind::inclination:
            case ReadingKind::azimuth:
                return of_one_facet(base);
            case ReadingKind::dihedral:
            case ReadingKind::edge:
                return of_two_facets(base);
            case ReadingKind::distance:
                return {of_two_places(base)};
            case ReadingKind::width:
            case ReadingKind::table_width:
                return {along_direction(base)};
            case ReadingKind::depth:
            case ReadingKind::volume:
            case ReadingKind::weight:
                return {of_whole_stone(base)};
            case ReadingKind::meet:
            case ReadingKind::parallel:
            case ReadingKind::coplanar:
                return {of_many_facets(base)};
            case ReadingKind::rotation:
            case ReadingKind::mirror:
                return {of_symmetry(base)};
        }
        fail("unknown kind");
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        const std::string who =
            written_->id.empty() ? written_->kind : written_->kind + " '" + written_->id + "'";
        throw InputError(written_->file, written_->line, who + ": " + what);
    }

    [[noreturn]] void refuse_kind() const {
        std::string known;
        for (int i = 0; i <= static_cast<int>(ReadingKind::mirror); ++i) {
            known += std::string(i == 0 ? "" : ", ") + name_of(static_cast<ReadingKind>(i));
        }
        throw InputError(
            written_->file, written_->line,
            fmt::format("unknown kind of reading '{}'; known are {}", written_->kind, known));
    }

    void set_value(Reading& reading) const {
        const WrittenReading& w = *written_;
        if (w.released && reading.kind != ReadingKind::meet) fail("only a meet can be released");
        if (is_relation(reading.kind)) {
            if (w.value) fail("has no value; leave it empty and give sigma or exact = true");
        } else if (!w.value) {
            fail("value is missing");
        } else {
            reading.value = *w.value;
            if (!std::isfinite(reading.value)) fail("value is not a finite number");
        }
        if (w.rounding) {
            if (!(*w.rounding > 0) || !std::isfinite(*w.rounding)) {
                fail(
                    fmt::format("rounding is {:g}; it must be positive (the step of the "
                                "instrument's display, such as 0.1)",
                                *w.rounding));
            }
            if (is_relation(reading.kind)) fail("takes no rounding: it has no value");
            reading.rounding = *w.rounding;
        }
        if (w.sigma) {
            if (!std::isfinite(*w.sigma)) fail("sigma is not a finite number");
            if (!(*w.sigma > 0)) {
                fail(
                    fmt::format("sigma is {:g}; it must be positive (one standard uncertainty), or "
                                "give exact = true",
                                *w.sigma));
            }
            reading.sigma = *w.sigma;
        } else if (!w.exact && !w.released && reading.kind != ReadingKind::meet && !w.rounding) {
            fail("sigma is missing (one standard uncertainty), or give exact = true");
        }
        if (w.exact && w.released) fail("cannot be exact and released");
        const double v = reading.value;
        switch (reading.kind) {
            case ReadingKind::inclination:
                if (v < 0 || v > 90) {
                    fail(
                        fmt::format("value {:g} is outside 0..90 degrees{}; pavilion facets count "
                                    "from the horizontal too",
                                    v, meant_inclination(v)));
                }
                break;
            case ReadingKind::azimuth:
                if (v < -360 || v > 360) fail(fmt::format("value {:g} is outside -360..360", v));
                break;
            case ReadingKind::dihedral:
                if (v <= 0 || v >= (stone_.convex ? 180 : 360)) {
                    fail(fmt::format("value {:g} is outside 0..180 degrees (interior angle)", v));
                }
                break;
            case ReadingKind::distance:
                if (v < 0) fail(fmt::format("value {:g} is a negative length", v));
                break;
            case ReadingKind::edge:
            case ReadingKind::width:
            case ReadingKind::depth:
            case ReadingKind::table_width:
            case ReadingKind::volume:
            case ReadingKind::weight:
                if (!(v > 0)) fail(fmt::format("value {:g} must be positive", v));
                break;
            default:
                break;
        }
        const bool angular = is_angle(reading.kind) || reading.kind == ReadingKind::parallel ||
                             reading.kind == ReadingKind::rotation ||
                             reading.kind == ReadingKind::mirror;
        if (angular) {
            reading.value = radians(reading.value);
            reading.sigma = radians(reading.sigma);
            reading.rounding = radians(reading.rounding);
        }
    }

    // What an impossible inclination may have been meant to be: the slip that comes near to the
    // facet of the mesh.
    std::string meant_inclination(double value) const {
        if (written_->of.size() != 1) return {};
        const auto found = facet_of_name_.find(written_->of[0]);
        if (found == facet_of_name_.end()) return {};
        const Vec3& normal = stone_.solid.facets[std::size_t(found->second)].plane.normal;
        const auto slip =
            find_slip(value, degrees(inclination(normal, stone_up())), k_slip_tolerance_deg, true);
        return slip ? fmt::format(" ({}: {:g}?)", slip->what, slip->corrected) : std::string();
    }

    Vec3 stone_up() const {
        const auto up = facet_of_name_.find(stone_.up_facet);
        return up == facet_of_name_.end()
                   ? stone_.up
                   : stone_.solid.facets[std::size_t(up->second)].plane.normal;
    }

    Datum datum(ReadingKind kind) const {
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
        return {Datum::Kind::facet, facet(name)};
    }

    int facet(const std::string& name) const {
        const auto found = facet_of_name_.find(name);
        if (found == facet_of_name_.end()) {
            fail(fmt::format("the mesh has no facet '{}' (near: {})", name,
                             near_names(stone_.solid, name)));
        }
        return found->second;
    }

    // A name, a pattern, or mean(), min(), max() of names and patterns.
    NamedFacets facets(const std::string& name) const {
        NamedFacets result;
        std::string inside = name;
        static constexpr std::array<std::pair<const char*, Aggregate>, 3> aggregates{
            {{"mean(", Aggregate::mean}, {"min(", Aggregate::min}, {"max(", Aggregate::max}}};
        for (const auto& [word, aggregate] : aggregates) {
            const std::string_view start(word);
            if (name.size() > start.size() && name.compare(0, start.size(), start) == 0 &&
                name.back() == ')') {
                result.aggregate = aggregate;
                inside = name.substr(start.size(), name.size() - start.size() - 1);
            }
        }
        std::size_t begin = 0;
        while (begin <= inside.size()) {
            const std::size_t end = std::min(inside.find_first_of("/,", begin), inside.size());
            std::string one = inside.substr(begin, end - begin);
            const auto first = one.find_first_not_of(' ');
            one = first == std::string::npos
                      ? std::string()
                      : one.substr(first, one.find_last_not_of(' ') - first + 1);
            add_facets(one, result);
            begin = end + 1;
        }
        return result;
    }

    void add_facets(const std::string& name, NamedFacets& to) const {
        if (name.empty()) fail("an empty facet name");
        if (facet_of_name_.count(name) > 0 || name.find('*') == std::string::npos) {
            to.facets.push_back(facet(name));
            return;
        }
        to.is_pattern = true;
        std::size_t found = 0;
        for (std::size_t i = 0; i < stone_.solid.facets.size(); ++i) {
            if (!matches(name, stone_.solid.facets[i].name)) continue;
            to.facets.push_back(static_cast<int>(i));
            ++found;
        }
        if (found == 0) {
            fail(fmt::format("no facet matches '{}' (near: {})", name,
                             near_names(stone_.solid, name)));
        }
    }

    std::string facet_name(int facet) const { return stone_.solid.facets[facet].name; }

    void need_names(std::size_t count, const char* what) const {
        if (written_->of.size() != count) {
            fail(fmt::format("names {} in `of`; expected {}", written_->of.size(), what));
        }
    }

    std::vector<Reading> of_one_facet(const Reading& base) const {
        need_names(1, "one facet");
        const NamedFacets named = facets(written_->of[0]);
        std::vector<Reading> readings;
        const bool spread = named.aggregate == Aggregate::single && named.is_pattern;
        if (named.aggregate != Aggregate::single && base.kind == ReadingKind::azimuth) {
            fail("azimuths have no mean, min or max; name one facet");
        }
        if (named.aggregate == Aggregate::single && !spread && named.facets.size() != 1) {
            fail("names several facets; write one reading for each, a pattern, or mean()");
        }
        const auto check_facet = [&](int f) {
            if (base.kind != ReadingKind::azimuth) return;
            if (facet_name(f) == stone_.up_facet) {
                fail("the facet that says what is up has no azimuth");
            }
        };
        if (!spread) {
            Reading reading = base;
            reading.of = written_->of;
            reading.aggregate = named.aggregate;
            reading.facets = named.facets;
            for (int f : named.facets) check_facet(f);
            return {reading};
        }
        for (int f : named.facets) {
            check_facet(f);
            Reading reading = base;
            reading.id = base.id + "." + facet_name(f);
            reading.of = {facet_name(f)};
            reading.facets = {f};
            readings.push_back(std::move(reading));
        }
        return readings;
    }

    bool share_edge(int a, int b) const {
        const std::vector<int>& other = stone_.solid.facets[b].corners;
        int shared = 0;
        for (int corner : stone_.solid.facets[a].corners) {
            shared += std::find(other.begin(), other.end(), corner) != other.end() ? 1 : 0;
        }
        return shared >= 2;
    }

    void need_edge(int a, int b) const {
        if (a == b) fail(fmt::format("names facet '{}' twice", facet_name(a)));
        if (!share_edge(a, b)) {
            fail(fmt::format("facets '{}' and '{}' share no edge in the mesh", facet_name(a),
                             facet_name(b)));
        }
    }

    std::vector<Reading> of_two_facets(const Reading& base) const {
        need_names(2, "two facets, such as T/S1");
        const NamedFacets first = facets(written_->of[0]), second = facets(written_->of[1]);
        const bool spread = (first.is_pattern && first.aggregate == Aggregate::single) ||
                            (second.is_pattern && second.aggregate == Aggregate::single);
        if (first.aggregate != Aggregate::single && second.aggregate != Aggregate::single) {
            fail("only one of the two names may be mean(), min() or max()");
        }
        const Aggregate aggregate =
            first.aggregate != Aggregate::single ? first.aggregate : second.aggregate;
        std::vector<Reading> readings;
        Reading shared = base;
        shared.of = written_->of;
        shared.aggregate = aggregate;
        for (int a : first.facets) {
            for (int b : second.facets) {
                const bool several = first.facets.size() > 1 || second.facets.size() > 1;
                // Of a pattern only the pairs that share an edge are meant.
                if (several && (a == b || !share_edge(a, b))) continue;
                need_edge(a, b);
                if (spread) {
                    Reading reading = base;
                    reading.id = fmt::format("{}.{}.{}", base.id, facet_name(a), facet_name(b));
                    reading.of = {facet_name(a), facet_name(b)};
                    reading.facets = {a, b};
                    readings.push_back(std::move(reading));
                } else {
                    shared.facets.push_back(a);
                    shared.facets.push_back(b);
                }
            }
        }
        if (!spread && !shared.facets.empty()) readings.push_back(std::move(shared));
        if (readings.empty()) fail("no two of the named facets share an edge in the mesh");
        return readings;
    }

    Place place(const std::string& name) const {
        Place result;
        if (facet_of_name_.count(name) > 0) {
            result.facet = facet(name);
            return result;
        }
        const std::size_t bar = name.find('|');
        if (bar != std::string::npos) {
            result.kind = Place::Kind::edge;
            result.facet = facet(name.substr(0, bar));
            result.other_facet = facet(name.substr(bar + 1));
            need_edge(result.facet, result.other_facet);
            return result;
        }
        if (name.size() > 1 && name[0] == 'v' &&
            name.find_first_not_of("0123456789", 1) == std::string::npos) {
            const auto number = plain_number(name.substr(1));
            if (!number || *number >= static_cast<double>(stone_.solid.vertices.size())) {
                fail(fmt::format("the mesh has no vertex '{}'; its vertices are v0 to v{}", name,
                                 stone_.solid.vertices.size() - 1));
            }
            result.kind = Place::Kind::vertex;
            result.vertex = static_cast<int>(*number);
            return result;
        }
        result.facet = facet(name);
        return result;
    }

    Reading of_two_places(const Reading& base) const {
        need_names(2, "two of facet, vertex (v0, v1, ...) and edge (A|B)");
        Reading reading = base;
        reading.of = written_->of;
        reading.places = {place(written_->of[0]), place(written_->of[1])};
        const Place &a = reading.places[0], &b = reading.places[1];
        if (a.kind == b.kind && a.facet == b.facet && a.other_facet == b.other_facet &&
            a.vertex == b.vertex) {
            fail("names the same thing twice");
        }
        if (a.kind == Place::Kind::facet && b.kind == Place::Kind::facet) {
            const Vec3 &m = stone_.solid.facets[a.facet].plane.normal,
                       &n = stone_.solid.facets[b.facet].plane.normal;
            // A rough mesh does not tell what is parallel.
            const bool rough = planarity(stone_.solid) > 0.01 * diameter(stone_.solid);
            if (!rough && glm::length(glm::cross(m, n)) > 0.35) {
                fail(fmt::format(
                    "facets '{}' and '{}' are not parallel in the mesh (they stand {:.0f} "
                    "degrees apart); name a vertex or an edge instead",
                    written_->of[0], written_->of[1],
                    degrees(std::acos(std::min(1.0, std::abs(glm::dot(m, n)))))));
            }
        }
        return reading;
    }

    Reading along_direction(const Reading& base) const {
        Reading reading = base;
        reading.of = written_->of;
        std::vector<double> numbers;
        for (const std::string& name : written_->of) {
            std::size_t begin = 0;
            while ((begin = name.find_first_not_of(" \t", begin)) != std::string::npos) {
                const std::size_t end = std::min(name.find_first_of(" \t", begin), name.size());
                const auto number = plain_number(std::string_view(name).substr(begin, end - begin));
                if (!number) {
                    fail(
                        fmt::format("`of` is '{}'; expected an azimuth in degrees (45) or a vector "
                                    "(1 0 0)",
                                    name));
                }
                numbers.push_back(*number);
                begin = end;
            }
        }
        if (numbers.size() == 1) {
            if (std::abs(numbers[0]) > 360) fail("the azimuth in `of` is outside -360..360");
            reading.azimuth = radians(numbers[0]);
        } else if (numbers.size() == 3 && base.kind == ReadingKind::width) {
            const Vec3 direction{numbers[0], numbers[1], numbers[2]};
            const double length = glm::length(direction);
            if (!(length > 0) || !std::isfinite(length))
                fail("the vector in `of` has no direction");
            reading.direction = direction / length;
            reading.has_direction = true;
        } else {
            fail(base.kind == ReadingKind::width
                     ? "expected an azimuth in degrees (45) or a vector (1 0 0) in `of`"
                     : "expected an azimuth in degrees in `of`");
        }
        if (base.kind == ReadingKind::table_width && stone_.up_facet.empty()) {
            fail("needs to know the table: set `up` of [stone] to its facet name");
        }
        return reading;
    }

    Reading of_whole_stone(const Reading& base) const {
        if (!written_->of.empty()) fail("is of the whole stone; leave `of` empty");
        if (base.kind == ReadingKind::weight && !stone_.material.density_g_cm3) {
            fail("needs the density: give `density` in [stone] or a material that has one");
        }
        return base;
    }

    Reading of_many_facets(const Reading& base) const {
        Reading reading = base;
        std::set<int> seen;
        for (const std::string& name : written_->of) {
            const NamedFacets named = facets(name);
            if (named.aggregate != Aggregate::single) fail("takes no mean, min or max");
            for (int f : named.facets) {
                if (!seen.insert(f).second)
                    fail(fmt::format("names facet '{}' twice", facet_name(f)));
                reading.facets.push_back(f);
                reading.of.push_back(facet_name(f));
            }
        }
        const std::size_t least = base.kind == ReadingKind::meet ? 3 : 2;
        if (reading.facets.size() < least) {
            fail(fmt::format("names {} facets; expected {} or more", reading.facets.size(), least));
        }
        return reading;
    }

    Reading of_symmetry(const Reading& base) const {
        Reading reading = base;
        reading.of = written_->of;
        std::size_t begin = 0;
        const auto number =
            written_->of.empty() ? std::nullopt : plain_number(written_->of.front());
        if (base.kind == ReadingKind::rotation) {
            if (!number || *number != std::floor(*number) || *number < 2 || *number > 1000) {
                fail("expected the order first in `of`: a whole number from 2, such as 8");
            }
            reading.order = static_cast<int>(*number);
            begin = 1;
        } else if (number) {
            reading.azimuth = radians(*number);
            reading.has_direction = true;
            begin = 1;
        }
        for (std::size_t i = begin; i < written_->of.size(); ++i) {
            const NamedFacets named = facets(written_->of[i]);
            if (named.aggregate != Aggregate::single) fail("takes no mean, min or max");
            reading.facets.insert(reading.facets.end(), named.facets.begin(), named.facets.end());
        }
        if (base.kind == ReadingKind::mirror && !number) {
            if (reading.facets.empty() || reading.facets.size() % 2 != 0) {
                fail("expected the azimuth of the plane's normal, or facets in pairs, in `of`");
            }
        } else {
            std::set<int> seen;
            for (int f : reading.facets) {
                if (!seen.insert(f).second)
                    fail(fmt::format("names facet '{}' twice", facet_name(f)));
            }
        }
        return reading;
    }

    const Stone& stone_;
    const WrittenReading* written_ = nullptr;
    std::map<std::string, int, std::less<>> facet_of_name_;
};

// Overall lengths of a stone and of its mesh agree within tens of per cent, whoever modelled it. A
// factor near one between two units is a slip of units, not a finding.
void refuse_other_unit(const Reading& reading, const Stone& stone) {
    double of_mesh = 0;
    if (reading.kind == ReadingKind::depth) {
        of_mesh = width_along(stone.solid, stone.up);
    } else if (reading.kind == ReadingKind::width) {
        // Any girdle direction will do to tell a factor of ten.
        of_mesh = diameter(stone.solid);
    } else if (reading.kind == ReadingKind::table_width) {
        const int table = find_facet(stone.solid, stone.up_facet);
        if (table < 0) return;
        Vec3 low(1e300), high(-1e300);
        for (int corner : stone.solid.facets[table].corners) {
            low = glm::min(low, stone.solid.vertices[corner]);
            high = glm::max(high, stone.solid.vertices[corner]);
        }
        of_mesh = glm::length(high - low) / std::numbers::sqrt2;
    } else {
        return;
    }
    if (!(of_mesh > 0)) return;
    const double ratio = reading.value / of_mesh;
    const double apart = std::max(ratio, 1 / ratio);
    static constexpr std::array<double, 4> factors{10, 25.4, 100, 1000};
    for (double factor : factors) {
        if (apart < factor / 1.5 || apart > factor * 1.5) continue;
        std::string guess;
        for (const LengthUnit unit :
             {LengthUnit::mm, LengthUnit::cm, LengthUnit::m, LengthUnit::inch}) {
            // value [unit] in the stone's unit would be value * mm_per(unit) / mm_per(stone.unit)
            const double wanted = mm_per(unit) / mm_per(stone.unit) * ratio;
            if (wanted > 1 / 1.5 && wanted < 1.5) guess = name_of(unit);
        }
        throw InputError(
            reading.file, reading.line,
            fmt::format("{} '{}' is {:g} {}, but the mesh measures {:.4g}: about {:g} times {}{}",
                        name_of(reading.kind), reading.id, reading.value, name_of(stone.unit),
                        of_mesh, factor, ratio > 1 ? "less" : "more",
                        guess.empty() ? "; check `unit` of [stone]"
                                      : fmt::format("; is the reading in {}? Every length must be "
                                                    "in the stone's unit ({})",
                                                    guess, name_of(stone.unit))));
    }
    if (apart > 5) {
        throw InputError(reading.file, reading.line,
                         fmt::format("{} '{}' is {:g} {}, but the mesh measures {:.4g}; check the "
                                     "value and `unit` of [stone]",
                                     name_of(reading.kind), reading.id, reading.value,
                                     name_of(stone.unit), of_mesh));
    }
}

// Three or more overall lengths that all ask for the same other size: then it is the mesh that was
// drawn in another unit, which is no matter, since only its shape counts.
bool mesh_is_in_another_unit(const std::vector<Reading>& readings, const Stone& stone) {
    std::vector<double> ratios;
    for (const Reading& r : readings) {
        const double mine = r.kind == ReadingKind::depth   ? width_along(stone.solid, stone.up)
                            : r.kind == ReadingKind::width ? diameter(stone.solid)
                                                           : 0;
        if (mine > 0 && r.value > 0) ratios.push_back(r.value / mine);
    }
    if (ratios.size() < 3) return false;
    std::sort(ratios.begin(), ratios.end());
    const double middle = ratios[ratios.size() / 2];
    // Proportions that are drawn wrong by half and more count for less than that.
    return std::max(middle, 1 / middle) > 2.5 && ratios.back() < 8 * ratios.front();
}

}  // namespace

std::vector<Reading> bind_readings(const std::vector<WrittenReading>& written, const Stone& stone) {
    Binder binder(stone);
    std::set<std::string> given;
    for (const WrittenReading& w : written) given.insert(w.id);
    std::map<std::string, const WrittenReading*> owner;
    std::vector<Reading> readings;
    for (std::size_t i = 0; i < written.size(); ++i) {
        std::string id = written[i].id;
        if (id.empty()) {
            id = "r" + std::to_string(i);
            while (given.count(id) > 0) id += "_";
        }
        for (Reading& reading : binder.bind(written[i], id)) {
            const auto [at, fresh] = owner.emplace(reading.id, &written[i]);
            if (!fresh) {
                throw InputError(
                    written[i].file, written[i].line,
                    fmt::format("the id '{}' is taken by the reading at {}:{}", reading.id,
                                at->second->file.filename().string(), at->second->line));
            }
            readings.push_back(std::move(reading));
        }
    }
    if (!mesh_is_in_another_unit(readings, stone)) {
        for (const Reading& reading : readings) refuse_other_unit(reading, stone);
    }
    return readings;
}

}  // namespace culet
