#include "fit/findings/fitted_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/checks.h"

namespace culet {

namespace {

void describe_meets(const System& system, const Shape& shape, FitResult& result) {
    std::vector<int> how(shape.points.size(), 0);
    double squares = 0;
    int count = 0;
    for (const Incidence& incidence : system.incidences()) {
        int& worst = how[incidence.point];
        worst = std::max(worst, static_cast<int>(incidence.how));
        if (incidence.how != MeetTreatment::soft) continue;
        const double miss = system.scale() * std::abs(glm::dot(shape.normals[incidence.facet],
                                                               shape.points[incidence.point]) -
                                                      shape.offsets[incidence.facet]);
        squares += miss * miss;
        ++count;
        result.statistics.meets.miss_max = std::max(result.statistics.meets.miss_max, miss);
    }
    for (int h : how) {
        ++(h == 0   ? result.statistics.meets.exact
           : h == 1 ? result.statistics.meets.soft
                    : result.statistics.meets.released);
    }
    if (count > 0) result.statistics.meets.miss_rms = std::sqrt(squares / count);
    if (system.has_common_meets()) {
        result.statistics.meets.sigma = system.group_sigmas()[0] * system.scale();
        result.statistics.meets.girdle_sigma = system.group_sigmas()[1] * system.scale();
        result.statistics.meets.estimated = !result.log.options.meet_sigma;
    }
}

// The solid that is written: corners from the fit, or what the planes enclose.
std::vector<std::string> make_solid(const System& system, const Shape& shape,
                                    const System::Pose& pose, FitResult& result) {
    std::vector<std::string> missing;
    Solid solid;
    if (system.splits()) {
        System::Enclosed enclosed = system.enclosed(shape);
        missing = enclosed.missing;
        solid = enclosed.closed ? std::move(enclosed.solid) : system.met_solid(shape);
    } else {
        solid = system.met_solid(shape);
    }
    for (Vec3& v : solid.vertices) v = system.outside_point(v, pose);
    for (Facet& facet : solid.facets) facet.plane = system.outside_plane(facet.plane, pose);
    result.solid = std::move(solid);
    return missing;
}

void fill_in_facets(const System& system, const Shape& shape, const Diagnosis& diagnosis,
                    const System::Pose& pose, FitResult& result) {
    for (std::size_t f = 0; f < system.stone().solid.facets.size(); ++f) {
        FittedFacet facet;
        facet.name = system.stone().solid.facets[f].name;
        const Vec3& n = shape.normals[f];
        facet.plane = system.outside_plane({n, shape.offsets[f]}, pose);
        facet.inclination = inclination(n, Vec3{0, 0, 1});
        const double level = std::hypot(n.x, n.y);
        facet.azimuth =
            level > 1e-9 ? azimuth(Vec3{std::cos(pose.turn) * n.x - std::sin(pose.turn) * n.y,
                                        std::sin(pose.turn) * n.x + std::cos(pose.turn) * n.y, 0})
                         : 0;
        const FacetSigma& sigma = diagnosis.facets[f];
        facet.sigma_inclination = sigma.inclination;
        facet.sigma_azimuth = sigma.azimuth;
        facet.sigma_offset = sigma.offset * system.scale();
        facet.read_inclination = sigma.read[0];
        facet.read_azimuth = sigma.read[1];
        facet.read_offset = sigma.read[2];
        const int there = find_facet(result.solid, facet.name);
        if (there >= 0) facet.area = area(result.solid, result.solid.facets[there]);
        facet.sigma_area = sigma.area * system.scale() * system.scale();
        result.facets.push_back(std::move(facet));
    }
    result.facet_covariance = diagnosis.facet_covariance;
    const std::size_t size = 3 * result.facets.size();
    for (std::size_t i = 0; i < result.facet_covariance.size(); ++i) {
        // Offsets are the third of each facet's three.
        if (i / size % 3 == 2) result.facet_covariance[i] *= system.scale();
        if (i % size % 3 == 2) result.facet_covariance[i] *= system.scale();
    }
}

void fill_in_readings(const System& system, const std::vector<Reading>& as_read,
                      const Diagnosis& diagnosis, const std::vector<double>& weights,
                      FitResult& result) {
    for (std::size_t r = 0; r < system.readings().size(); ++r) {
        const Reading& reading = system.readings()[r];
        const ReadingCheck& c = diagnosis.readings[r];
        FittedReading fitted = as_taken(reading);
        if (system.has_prior()) fitted.sigma = as_read[r].sigma;
        if (is_relation(reading.kind) && reading.sigma == 0 && !reading.exact) {
            fitted.sigma = reading.released ? 0 : system.group_sigmas()[0] * system.scale();
        }
        fitted.fitted = reading.value + c.residual;
        fitted.residual = c.residual;
        fitted.normalized = c.normalized;
        fitted.redundancy = c.redundancy;
        fitted.detectable = c.detectable;
        fitted.suspect = c.suspect;
        if (!weights.empty()) fitted.weight = weights[r];
        result.readings.push_back(std::move(fitted));
    }
    for (int s : diagnosis.suspects) {
        result.findings.suspects.push_back(system.readings()[std::size_t(s)].id);
    }
}

}  // namespace

FittedReading as_taken(const Reading& reading) {
    FittedReading fitted;
    fitted.id = reading.id;
    fitted.kind = reading.kind;
    fitted.of = reading.of;
    fitted.value = reading.value;
    fitted.sigma = reading.sigma;
    fitted.exact = reading.exact;
    fitted.rounding = reading.rounding;
    return fitted;
}

void fill_in(const System& system, const std::vector<Reading>& as_read, const Shape& shape,
             const Diagnosis& diagnosis, const System::Pose& pose,
             const std::vector<double>& weights, FitResult& result) {
    result.checks.missing_facets = make_solid(system, shape, pose, result);
    result.checks.planarity_max = planarity(result.solid);
    result.checks.closed = is_closed(result.solid);
    result.checks.convex = is_convex(result.solid);
    result.azimuth_zero = system.azimuth_zero(pose);
    describe_meets(system, shape, result);
    if (system.has_prior()) {
        const PriorSigmas& s = system.prior_sigmas();
        result.statistics.prior = {result.log.options.prior.source, s[0], s[1],
                                   s[2] * system.scale(), s[3] * system.scale()};
    }
    fill_in_facets(system, shape, diagnosis, pose, result);
    fill_in_readings(system, as_read, diagnosis, weights, result);
}

void put_left_out(const std::vector<Reading>& readings, const std::vector<std::size_t>& left_out,
                  FitResult& result) {
    std::string ids;
    for (const std::size_t i : left_out) {
        const Reading& r = readings[i];
        FittedReading fitted = as_taken(r);
        fitted.fitted = fitted.residual = fitted.normalized = fitted.redundancy =
            std::numeric_limits<double>::quiet_NaN();
        fitted.left_out = "the facet lies level within its uncertainty and has no azimuth";
        result.readings.insert(result.readings.begin() + std::ptrdiff_t(i), std::move(fitted));
        ids += (ids.empty() ? "" : ", ") + r.id;
        if (!r.of.empty()) ids += fmt::format(" (of {})", r.of.front());
    }
    result.log.notes.push_back(
        fmt::format("azimuth {} left out: the facet lies level within its uncertainty, and a level "
                    "facet has no azimuth",
                    ids));
    result.message += "; " + result.log.notes.back();
}

}  // namespace culet
