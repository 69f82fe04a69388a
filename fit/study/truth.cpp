// Truth, draws and errors of a study.

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "fit/study/parts.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// A facet more level than this has no azimuth to speak of.
constexpr double k_level = 1e-6;
// The reading of a facet that is nearly upright does not say which way it leans: of these only
// azimuths are compared, since the limit knows nothing of such a choice.
constexpr double k_upright = radians(5);

bool is_upright(double inclination) {
    return std::abs(inclination - std::numbers::pi / 2) < k_upright;
}

// Up in the frame of a fitted solid.
Vec3 up_of(const Stone& stone, const FitResult& fitted) {
    if (const int facet = find_facet(fitted.solid, stone.up_facet); facet >= 0) {
        return fitted.solid.facets[static_cast<std::size_t>(facet)].plane.normal;
    }
    // The fit lays it on a coordinate axis that is near.
    for (int k = 0; k < 3; ++k) {
        if (std::abs(stone.up[k]) < std::cos(radians(20))) continue;
        Vec3 axis(0);
        axis[k] = std::copysign(1, stone.up[k]);
        return axis;
    }
    return stone.up;
}

// Inclinations count from above all the way, 0 .. pi: folded at the horizon they would hide half of
// the errors of upright facets.
std::map<std::string, StudyTruth::Place> places_of(const Stone& stone, const FitResult& fitted,
                                                   bool from_corner_mean) {
    const Vec3 up = up_of(stone, fitted);
    Vec3 middle(0);
    if (from_corner_mean) {
        for (const Vec3& v : fitted.solid.vertices) {
            middle += v / static_cast<double>(fitted.solid.vertices.size());
        }
    } else {
        middle = centroid(fitted.solid);
    }
    std::map<std::string, StudyTruth::Place> places;
    for (const FittedFacet& f : fitted.facets) {
        const bool below = glm::dot(f.plane.normal, up) < 0;
        places[f.name] = {below ? std::numbers::pi - f.inclination : f.inclination,
                          f.azimuth - fitted.azimuth_zero,
                          f.plane.offset - glm::dot(f.plane.normal, middle)};
    }
    return places;
}

bool fixes_azimuth(const Reading& reading) {
    switch (reading.kind) {
        case ReadingKind::azimuth:
        case ReadingKind::width:
        case ReadingKind::table_width:
            return true;
        default:
            return false;
    }
}

}  // namespace

void StudyBudget::report(double fraction) const {
    if (progress_ && !progress_(fraction)) throw Interrupted();
}

StudyTruth truth_of(const Stone& stone, const std::vector<Reading>& readings,
                    const FitResult& fitted, bool from_corner_mean) {
    StudyTruth truth;
    truth.stone = stone;
    truth.stone.solid = fitted.solid;
    truth.readings = readings;
    truth.from_corner_mean = from_corner_mean;
    truth.azimuths_read = stone.azimuth_from_mesh;
    for (std::size_t r = 0; r < readings.size(); ++r) {
        truth.azimuths_read = truth.azimuths_read || fixes_azimuth(readings[r]);
        if (!is_relation(readings[r].kind)) truth.readings[r].value = fitted.readings[r].fitted;
    }
    truth.places = places_of(stone, fitted, from_corner_mean);
    return truth;
}

std::vector<Reading> drawn_readings(const std::vector<Reading>& readings, std::uint64_t seed,
                                    int draw) {
    std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                           static_cast<std::uint32_t>(draw)};
    std::mt19937_64 random(sequence);
    std::normal_distribution<double> normal;
    std::vector<Reading> drawn = readings;
    for (Reading& reading : drawn) {
        const double error = normal(random);
        if (!reading.exact && !is_relation(reading.kind)) reading.value += reading.sigma * error;
    }
    return drawn;
}

StudyError error_of(const StudyTruth& truth, const FitResult& fitted) {
    StudyError sum;
    double angles = 0, offsets = 0;
    for (const auto& [name, place] : places_of(truth.stone, fitted, truth.from_corner_mean)) {
        const auto found = truth.places.find(name);
        if (found == truth.places.end()) continue;
        const StudyTruth::Place& right = found->second;
        const double off = place.offset - right.offset;
        sum.offset += off * off;
        ++offsets;
        const double level = std::sin(right.inclination);
        if (level < k_level) continue;
        const double tilt =
            is_upright(right.inclination) ? 0 : place.inclination - right.inclination;
        const double turn =
            truth.azimuths_read
                ? level * std::remainder(place.azimuth - right.azimuth, 2 * std::numbers::pi)
                : 0;
        sum.angle += tilt * tilt + turn * turn;
        ++angles;
    }
    return {angles > 0 ? sum.angle / angles : 0, offsets > 0 ? sum.offset / offsets : 0};
}

StudyError limit_of(const StudyTruth& truth, const FitResult& fitted) {
    StudyError sum;
    double angles = 0, offsets = 0;
    for (const FittedFacet& f : fitted.facets) {
        sum.offset += f.sigma_offset * f.sigma_offset;
        ++offsets;
        const double level = std::sin(f.inclination);
        if (level < k_level) continue;
        const double turn = truth.azimuths_read ? level * f.sigma_azimuth : 0;
        const double tilt = is_upright(f.inclination) ? 0 : f.sigma_inclination;
        sum.angle += tilt * tilt + turn * turn;
        ++angles;
    }
    return {angles > 0 ? sum.angle / angles : 0, offsets > 0 ? sum.offset / offsets : 0};
}

bool is_sound(const Stone& stone, const FitResult& fitted) {
    return fitted.checks.closed && (fitted.checks.convex || !stone.convex) &&
           fitted.checks.missing_facets.empty();
}

bool is_settled(const Stone& stone, const FitResult& fitted) {
    return is_sound(stone, fitted) && fitted.status != FitStatus::not_converged;
}

}  // namespace culet
