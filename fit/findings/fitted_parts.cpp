// Writes the parts of a result: solid, facets, readings, meets.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/findings/blunder.h"
#include "fit/findings/describe.h"
#include "fit/model/enclosed.h"
#include "fit/readings/seen_lines.h"
#include "fit/uncertainty/statistics.h"
#include "stone/solid/checks.h"

namespace culet {

namespace {

// Radians: a direction nearer to up has no azimuth.
constexpr double k_level = 1e-9;

void describe_meets(const FitModel& model, const Shape& shape, FitResult& result) {
    std::vector<int> how(shape.points.size(), 0);
    double squares = 0;
    int count = 0;
    for (const Incidence& incidence : model.meets().incidences) {
        int& worst = how[incidence.point];
        worst = std::max(worst, static_cast<int>(incidence.how));
        if (incidence.how != MeetTreatment::soft) continue;
        const double miss =
            model.frame().scale() *
            std::abs(glm::dot(shape.normals[incidence.facet], shape.points[incidence.point]) -
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
    if (model.meets().has_common()) {
        result.statistics.meets.sigma = model.meets().group_sigmas[0] * model.frame().scale();
        result.statistics.meets.girdle_sigma =
            model.meets().group_sigmas[1] * model.frame().scale();
        result.statistics.meets.estimated = !result.log.options.meet_sigma;
    }
}

std::vector<std::string> make_solid(const FitModel& model, const Shape& shape,
                                    const Frame::Pose& pose, FitResult& result) {
    std::vector<std::string> missing;
    Solid solid;
    if (model.meets().splits) {
        Enclosed enclosed = enclosed_by(model, shape);
        missing = enclosed.missing;
        solid = enclosed.closed ? std::move(enclosed.solid) : met_solid(model, shape);
    } else {
        solid = met_solid(model, shape);
    }
    for (Vec3& v : solid.vertices) v = model.frame().outside_point(v, pose);
    for (Facet& facet : solid.facets) facet.plane = model.frame().outside_plane(facet.plane, pose);
    result.solid = std::move(solid);
    return missing;
}

void fill_in_facets(const FitModel& model, const Shape& shape, const Diagnosis& diagnosis,
                    const Frame::Pose& pose, FitResult& result) {
    for (std::size_t f = 0; f < model.stone().solid.facets.size(); ++f) {
        FittedFacet facet;
        facet.name = model.stone().solid.facets[f].name;
        const Vec3& n = shape.normals[f];
        facet.plane = model.frame().outside_plane({n, shape.offsets[f]}, pose);
        facet.inclination = inclination(n, Vec3{0, 0, 1});
        facet.azimuth = outside_azimuth(n, pose);
        const FacetSigma& sigma = diagnosis.facets[f];
        facet.sigma_inclination = sigma.inclination;
        facet.sigma_azimuth = sigma.azimuth;
        facet.sigma_offset = sigma.offset * model.frame().scale();
        facet.read_inclination = sigma.read[0];
        facet.read_azimuth = sigma.read[1];
        facet.read_offset = sigma.read[2];
        const int there = find_facet(result.solid, facet.name);
        if (there >= 0) facet.area = area(result.solid, result.solid.facets[there]);
        facet.sigma_area = sigma.area * model.frame().scale() * model.frame().scale();
        result.facets.push_back(std::move(facet));
    }
    result.facet_covariance = diagnosis.facet_covariance;
    const std::size_t size = 3 * result.facets.size();
    for (std::size_t i = 0; i < result.facet_covariance.size(); ++i) {
        // Offsets are the third of each facet's parameters.
        if (i / size % 3 == 2) result.facet_covariance[i] *= model.frame().scale();
        if (i % size % 3 == 2) result.facet_covariance[i] *= model.frame().scale();
    }
}

LineFinding line_finding(const Reading& reading, const Vec3& picture, double pixels) {
    const SeenLine& line = *reading.seen_line;
    LineFinding finding;
    finding.points = int(line.points.size());
    for (const glm::dvec2& p : line.points) {
        const glm::dvec2 d = p - line.middle;
        const double along = glm::dot(line.along, d),
                     across = line.along.x * d.y - line.along.y * d.x,
                     off = std::abs(picture.x * along + picture.y * across + picture.z * pixels);
        finding.rms += off * off / finding.points;
        if (!(off < finding.worst)) {
            finding.worst = off;
            finding.u = p.x;
            finding.v = p.y;
        }
    }
    finding.rms = std::sqrt(finding.rms);
    return finding;
}

// Says whose points are farther from a straight line than chance would have it.
std::string scatter_words(const std::vector<Reading>& readings, double significance) {
    int count = 0;
    double most = 0;
    std::string worst;
    for (const Reading& r : readings) {
        if (!r.seen_line) continue;
        const double points = double(r.seen_line->points.size());
        const double chi2 = r.seen_line->scatter / (points * r.sigma * r.sigma), dof = points - 2;
        if (!(dof > 0) || chi2 <= chi2_quantile(significance, dof)) continue;
        ++count;
        if (chi2 / dof <= most) continue;
        most = chi2 / dof;
        worst = r.id;
    }
    if (count == 0) return {};
    return fmt::format(
        "the points of {} line{} lie farther from a straight one than their sigma says, most those "
        "of {} ({:.1f} times)",
        count, count == 1 ? "" : "s", worst, std::sqrt(most));
}

void fill_in_readings(const FitModel& model, const Shape& shape,
                      const std::vector<Reading>& as_read, const Diagnosis& diagnosis,
                      const std::vector<double>& weights, FitResult& result) {
    for (std::size_t r = 0; r < model.readings().size(); ++r) {
        const Reading& reading = model.readings()[r];
        const ReadingCheck& c = diagnosis.readings[r];
        FittedReading fitted = as_taken(reading);
        if (!model.prior().empty()) fitted.sigma = as_read[r].sigma;
        if (is_relation(reading.kind) && reading.sigma == 0 && !reading.exact) {
            fitted.sigma =
                reading.released ? 0 : model.meets().group_sigmas[0] * model.frame().scale();
        }
        fitted.fitted = reading.value + c.residual;
        fitted.residual = c.residual;
        fitted.normalized = c.normalized;
        fitted.redundancy = c.redundancy;
        fitted.detectable = c.detectable;
        fitted.suspect = c.suspect;
        if (const LineView* view = model.lines().of(r)) {
            fitted.line =
                line_finding(reading, picture_of(*view, shape), model.frame().unit_of(reading));
        }
        if (!weights.empty()) fitted.weight = weights[r];
        result.readings.push_back(std::move(fitted));
    }
    std::string scatter = scatter_words(as_read, result.log.options.significance);
    if (!scatter.empty()) result.log.notes.push_back(std::move(scatter));
    for (int s : diagnosis.suspects) {
        result.findings.suspects.push_back(model.readings()[std::size_t(s)].id);
    }
}

}  // namespace

double outside_azimuth(const Vec3& inside, const Frame::Pose& pose) {
    const double c = std::cos(pose.turn), s = std::sin(pose.turn);
    if (!(std::hypot(inside.x, inside.y) > k_level)) return 0;
    return azimuth(Vec3{c * inside.x - s * inside.y, s * inside.x + c * inside.y, 0});
}

void fill_in(const FitModel& model, const std::vector<Reading>& as_read, const Shape& shape,
             const Diagnosis& diagnosis, const Frame::Pose& pose,
             const std::vector<double>& weights, FitResult& result) {
    result.checks.missing_facets = make_solid(model, shape, pose, result);
    result.checks.planarity_max = planarity(result.solid);
    result.checks.closed = is_closed(result.solid);
    result.checks.convex = is_convex(result.solid);
    result.azimuth_zero = pose.turn;
    describe_meets(model, shape, result);
    if (!model.prior().empty()) {
        const PriorSigmas& s = model.prior().sigmas;
        result.statistics.prior = {result.log.options.prior.source, s[0], s[1],
                                   s[2] * model.frame().scale(), s[3] * model.frame().scale()};
    }
    fill_in_facets(model, shape, diagnosis, pose, result);
    fill_in_readings(model, shape, as_read, diagnosis, weights, result);
}

}  // namespace culet
