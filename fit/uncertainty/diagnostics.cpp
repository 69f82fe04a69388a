#include "fit/uncertainty/diagnostics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "fit/model/equations.h"
#include "fit/model/facet_functions.h"
#include "fit/model/linear.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/constants.h"
#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/inconsistent_subset.h"
#include "fit/uncertainty/observations.h"
#include "fit/uncertainty/shares.h"
#include "fit/uncertainty/statistics.h"
#include "fit/uncertainty/suspects.h"

namespace culet {

namespace {

bool has_azimuth(const Shape& shape, int facet) {
    const Vec3& n = shape.normals[std::size_t(facet)];
    return std::hypot(n.x, n.y) > 1e-9;
}

void find_rank_defect(const FitModel& model, const Shape& shape, const Covariance& covariance,
                      const Vec3& middle, Diagnosis& diagnosis) {
    diagnosis.rank_defect = covariance.rank_defect();
    if (diagnosis.rank_defect == 0) return;
    const Layout layout = layout_of(shape);
    // Name parameters that the unobservable directions together may move by a tenth of the mesh's
    // uncertainty.
    for (int f = 0; f < layout.facets; ++f) {
        const auto rows = facet_functions(shape, f, layout, middle);
        static constexpr std::array<const char*, 3> names{"inclination", "azimuth", "offset"};
        for (std::size_t k = 0; k < 3; ++k) {
            if (k == 1 && !has_azimuth(shape, f)) continue;
            if (std::sqrt(covariance.open_variance(rows[k])) > 0.02) {
                diagnosis.undetermined.push_back({model.stone().solid.facets[f].name, names[k]});
            }
        }
    }
}

void residuals_only(const FitModel& model, const Linearised& linear,
                    const std::vector<Observation>& observations, Diagnosis& diagnosis) {
    diagnosis.analysed = false;
    constexpr double k_none = std::numeric_limits<double>::quiet_NaN();
    for (ReadingCheck& c : diagnosis.readings) c.normalized = c.redundancy = k_none;
    for (FacetSigma& s : diagnosis.facets) s = {k_none, k_none, k_none, k_none};
    const auto note = [&](int reading, double residual) {
        if (reading < 0) return;
        ReadingCheck& c = diagnosis.readings[std::size_t(reading)];
        const double in_units =
            residual * model.frame().unit_of(model.readings()[std::size_t(reading)]);
        if (std::abs(in_units) > std::abs(c.residual)) c.residual = in_units;
    };
    for (const Observation& o : observations) note(o.reading, o.residual(linear) * o.sigma);
    for (std::size_t i = 0; i < linear.hard.size(); ++i) {
        note(linear.hard[i].reading, linear.hard_residuals(Eigen::Index(i)));
    }
    // Bounds from counting.
    diagnosis.dof = double(observations.size());
    const Eigen::Index equations = Eigen::Index(observations.size()) + linear.hard_rows.rows() +
                                   Eigen::Index(linear.gauge_rows.size());
    diagnosis.rank_defect =
        static_cast<int>(std::max<Eigen::Index>(0, linear.layout.size() - equations));
}

std::vector<double> redundancies_of(const std::vector<Observation>& observations,
                                    const Covariance& covariance) {
    std::vector<double> redundancy;
    for (const Observation& o : observations) {
        const double own = 1 - o.leverage(covariance);
        redundancy.push_back(own < k_checks.no_redundancy ? 0 : own);
    }
    return redundancy;
}

// Degrees of freedom, and the sums for variance components.
void sum_up(const Linearised& linear, const std::vector<Observation>& observations,
            const std::vector<double>& redundancy, int binding, Diagnosis& diagnosis) {
    diagnosis.dof = binding;
    for (std::size_t i = 0; i < observations.size(); ++i) {
        diagnosis.dof += redundancy[i];
        const Equation& e = linear.soft[std::size_t(observations[i].equation)];
        if (e.group >= 0) {
            const double miss = observations[i].residual(linear) * e.sigma;
            diagnosis.group_squares[std::size_t(e.group)] += miss * miss;
            diagnosis.group_redundancy[std::size_t(e.group)] += redundancy[i];
        }
    }
}

// With a prior, whose terms are no readings: of the readings alone. One value that was read for
// several facets counts once.
void count_readings_alone(const FitModel& model, const Linearised& linear,
                          const std::vector<Observation>& observations,
                          const std::vector<double>& redundancy, int binding,
                          Diagnosis& diagnosis) {
    diagnosis.chi2 = 0;
    diagnosis.dof = binding;
    std::map<std::pair<std::string, long>, std::vector<double>> rows;
    for (std::size_t i = 0; i < observations.size(); ++i) {
        const Observation& o = observations[i];
        if (o.reading < 0) continue;
        const Reading& r = model.readings()[std::size_t(o.reading)];
        diagnosis.chi2 += std::pow(o.residual(linear), 2);
        if (r.line > 0 && !is_relation(r.kind)) {
            rows[{r.file.string(), r.line}].push_back(redundancy[i]);
        } else {
            diagnosis.dof += redundancy[i];
        }
    }
    for (const auto& [row, all] : rows) {
        diagnosis.dof += std::accumulate(all.begin(), all.end(), 0.0) / double(all.size());
    }
}

// The worst of a reading's equations represents it.
void check_readings(const FitModel& model, const Linearised& linear,
                    const std::vector<Observation>& observations,
                    const std::vector<double>& redundancy, Diagnosis& diagnosis) {
    std::vector<int> terms(model.readings().size(), 0);
    const auto note = [&](int which, double sigma, double residual, double r, double w) {
        if (which < 0) return;
        const Reading& reading = model.readings()[std::size_t(which)];
        ReadingCheck& c = diagnosis.readings[std::size_t(which)];
        const double unit = model.frame().unit_of(reading);
        if (terms[std::size_t(which)]++ == 0 || std::abs(residual * unit) > std::abs(c.residual)) {
            c.residual = residual * unit;
        }
        if (std::abs(w) > std::abs(c.normalized)) c.normalized = w;
        c.redundancy += r;
        if (r > k_checks.no_redundancy) {
            const double found =
                sigma * unit * (diagnosis.suspect_limit + k_checks.power_80) / std::sqrt(r);
            c.detectable = c.detectable == 0 ? found : std::max(c.detectable, found);
        }
    };
    for (std::size_t i = 0; i < observations.size(); ++i) {
        const Observation& o = observations[i];
        const double scaled = o.residual(linear);
        const double w =
            redundancy[i] > k_checks.no_redundancy ? scaled / std::sqrt(redundancy[i]) : 0;
        note(o.reading, o.sigma, scaled * o.sigma, redundancy[i], w);
    }
    for (std::size_t i = 0; i < linear.hard.size(); ++i) {
        note(linear.hard[i].reading, 1, linear.hard_residuals(Eigen::Index(i)), 0, 0);
    }
    for (std::size_t r = 0; r < terms.size(); ++r) {
        if (terms[r] > 0) diagnosis.readings[r].redundancy /= terms[r];
    }
}

// Inclination, azimuth and offset of each facet in the result's frame, which turns with the mesh.
std::vector<FunctionRow> facet_rows(const FitModel& model, const Shape& shape, const Vec3& middle) {
    const Layout layout = layout_of(shape);
    const FunctionRow turn = RowWriter(shape).function(model.frame().turn_of(shape));
    std::vector<FunctionRow> rows;
    for (int f = 0; f < layout.facets; ++f) {
        std::array<FunctionRow, 3> three = facet_functions(shape, f, layout, middle);
        if (has_azimuth(shape, f)) three[1] = three[1] + turn;
        for (FunctionRow& row : three) rows.push_back(std::move(row));
    }
    return rows;
}

void find_facet_sigmas(const Shape& shape, const Outline& outline, const Covariance& covariance,
                       const std::vector<FunctionRow>& rows, Diagnosis& diagnosis) {
    const RowWriter writer(shape);
    for (std::size_t f = 0; f < diagnosis.facets.size(); ++f) {
        const auto sigma_of = [&](const FunctionRow& row) {
            return std::sqrt(covariance.total_variance(row));
        };
        FacetSigma& sigma = diagnosis.facets[f];
        sigma.inclination = sigma_of(rows[3 * f]);
        sigma.azimuth = has_azimuth(shape, int(f)) ? sigma_of(rows[3 * f + 1])
                                                   : std::numeric_limits<double>::quiet_NaN();
        sigma.offset = sigma_of(rows[3 * f + 2]);
        if (outline.loops[f].size() < 3) continue;
        std::vector<Corner> loop;
        for (int c : outline.loops[f]) loop.push_back(outline.corners[c]);
        sigma.area = sigma_of(writer.function(enclosed_area(loop)(shape)));
    }
}

void find_facet_covariance(const Covariance& covariance, const std::vector<FunctionRow>& rows,
                           Diagnosis& diagnosis) {
    diagnosis.facet_covariance.assign(rows.size() * rows.size(), 0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].nonZeros() == 0) continue;
        const Eigen::VectorXd with_row = covariance.with_all(rows[i], true);
        for (std::size_t j = 0; j <= i; ++j) {
            const double both = rows[j].dot(with_row);
            diagnosis.facet_covariance[i * rows.size() + j] = both;
            diagnosis.facet_covariance[j * rows.size() + i] = both;
        }
    }
}

}  // namespace

Diagnosis diagnose(const FitModel& model, const Shape& shape,
                   const std::shared_ptr<const Outline>& outline, const DiagnosisOptions& options) {
    Diagnosis diagnosis;
    const auto covariance = std::make_shared<const Covariance>(linearise(model, shape, outline));
    const Linearised& linear = covariance->linear();
    diagnosis.chi2 = linear.chi2();
    diagnosis.readings.resize(model.readings().size());
    diagnosis.facets.resize(shape.normals.size());
    const std::vector<Observation> observations = observations_of(linear);
    if (!covariance->usable()) {
        residuals_only(model, linear, observations, diagnosis);
        return diagnosis;
    }
    const std::vector<double> redundancy = redundancies_of(observations, *covariance);
    sum_up(linear, observations, redundancy, options.binding, diagnosis);
    if (!options.full) return diagnosis;
    if (!model.prior().empty()) {
        count_readings_alone(model, linear, observations, redundancy, options.binding, diagnosis);
    }
    diagnosis.covariance = covariance;
    diagnosis.suspect_limit = two_sided_normal_quantile(
        options.significance / std::max<double>(1, double(observations.size())));
    check_readings(model, linear, observations, redundancy, diagnosis);
    find_suspects(model, options.significance, diagnosis);
    if (linear.worst_hard() > k_hard_limit) {
        diagnosis.disagreeing = inconsistent_exact_readings(model, shape, outline);
    }
    const Vec3 middle = middle_of(shape);
    const std::vector<FunctionRow> rows = facet_rows(model, shape, middle);
    find_facet_sigmas(shape, *outline, *covariance, rows, diagnosis);
    if (shape.normals.size() <= k_checks.most_facets_together)
        find_facet_covariance(*covariance, rows, diagnosis);
    if (!model.prior().empty()) find_parts_read(shape, *covariance, middle, diagnosis);
    find_rank_defect(model, shape, *covariance, middle, diagnosis);
    return diagnosis;
}

}  // namespace culet
