// Truth, draws and errors of a study.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "fit/study/parts.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// A facet more level than this has no usable azimuth.
constexpr double k_level = 1e-6;
// A reading of a nearly upright facet does not say to which side it leans; the limit does not count
// that choice, so only azimuths are compared.
constexpr double k_upright = radians(5);

bool is_upright(double inclination) {
    return std::abs(inclination - std::numbers::pi / 2) < k_upright;
}

// Up in the frame of a fitted solid.
Vec3 up_of(const Stone& stone, const FitResult& fitted) {
    if (const int facet = find_facet(fitted.solid, stone.up_facet); facet >= 0) {
        return fitted.solid.facets[static_cast<std::size_t>(facet)].plane.normal;
    }
    // The fit turns `up` to a coordinate axis within 20 degrees.
    for (int k = 0; k < 3; ++k) {
        if (std::abs(stone.up[k]) < std::cos(radians(20))) continue;
        Vec3 axis(0);
        axis[k] = std::copysign(1, stone.up[k]);
        return axis;
    }
    return stone.up;
}

// Inclinations count from up, 0 .. pi: from the nearer side they would hide half of the errors of
// upright facets.
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
    return reading.kind == ReadingKind::azimuth || reading.kind == ReadingKind::width ||
           reading.kind == ReadingKind::table_width;
}

// Mean squares over facets of their errors or sigmas.
class SumOfFacets {
public:
    explicit SumOfFacets(bool azimuths_read) : azimuths_read_(azimuths_read) {}
    void add(double inclination, double tilt, double turn, double offset) {
        sum_.offset += offset * offset;
        ++offsets_;
        const double level = std::sin(inclination);
        if (level < k_level) return;
        if (!is_upright(inclination)) sum_.angle += tilt * tilt;
        if (azimuths_read_) sum_.angle += level * turn * level * turn;
        ++angles_;
    }
    StudyError mean() const {
        return {sum_.angle / std::max(1.0, angles_), sum_.offset / std::max(1.0, offsets_)};
    }

private:
    bool azimuths_read_;
    StudyError sum_;
    double angles_ = 0, offsets_ = 0;
};

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
    SumOfFacets sum(truth.azimuths_read);
    for (const auto& [name, place] : places_of(truth.stone, fitted, truth.from_corner_mean)) {
        const auto found = truth.places.find(name);
        if (found == truth.places.end()) continue;
        const StudyTruth::Place& right = found->second;
        sum.add(right.inclination, place.inclination - right.inclination,
                std::remainder(place.azimuth - right.azimuth, 2 * std::numbers::pi),
                place.offset - right.offset);
    }
    return sum.mean();
}

StudyError limit_of(const StudyTruth& truth, const FitResult& fitted) {
    SumOfFacets sum(truth.azimuths_read);
    for (const FittedFacet& f : fitted.facets) {
        sum.add(f.inclination, f.sigma_inclination, f.sigma_azimuth, f.sigma_offset);
    }
    return sum.mean();
}

StudyError mean_of(const std::vector<StudyError>& errors) {
    StudyError mean;
    for (const StudyError& e : errors) {
        mean.angle += e.angle / double(errors.size());
        mean.offset += e.offset / double(errors.size());
    }
    return mean;
}

bool is_sound(const Stone& stone, const FitResult& fitted) {
    return fitted.checks.closed && (fitted.checks.convex || !stone.convex) &&
           fitted.checks.missing_facets.empty();
}

bool is_settled(const Stone& stone, const FitResult& fitted) {
    return is_sound(stone, fitted) && fitted.status != FitStatus::not_converged;
}

}  // namespace culet
