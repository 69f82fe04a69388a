#include "fit/uncertainty/diagnostics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "fit/model/facet_functions.h"
#include "fit/model/linear.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/inconsistent_subset.h"
#include "fit/uncertainty/shares.h"
#include "fit/uncertainty/snooping.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

namespace {

// A redundancy this small is rounding: nothing checks the equation.
constexpr double k_no_redundancy = 1e-6;
// An error of size limit + 0.84 sigma is found in 80 of 100 cases.
constexpr double k_power_80 = 0.8416212335729143;

// A reading's part in an equation that counts. Where several share it, `part` of them all is its
// own weight's root: residual_i = part (residual - off / sigma), and of the hat matrix the entries
// of two readings are those of their equations times both parts.
struct Said {
    Eigen::Index equation = -1;
    int reading = -1;
    double off = 0, sigma = 1, part = 1;

    // In sigmas.
    double residual(const Linearised& linear) const {
        const Equation& e = linear.soft[std::size_t(equation)];
        return e.replicates.empty() ? linear.soft_residuals(equation)
                                    : (linear.soft_residuals(equation) * e.sigma - off) / sigma;
    }
    double leverage(const Covariance& covariance) const {
        return part * part * covariance.leverages()(equation);
    }
};

// In the order in which they would stand if none shared an equation.
std::vector<Said> all_said(const Linearised& linear) {
    std::vector<Said> all;
    for (std::size_t i = 0; i < linear.soft.size(); ++i) {
        const Equation& e = linear.soft[i];
        if (!e.is_counted()) continue;
        if (e.replicates.empty()) all.push_back({Eigen::Index(i), e.reading, 0, e.sigma, 1});
        for (const Replicate& r : e.replicates) {
            all.push_back({Eigen::Index(i), r.reading, r.off, r.sigma, e.sigma / r.sigma});
        }
    }
    const auto place = [&](const Said& said) {
        return linear.soft[std::size_t(said.equation)].incidence >= 0 ? -1 : said.reading;
    };
    std::stable_sort(all.begin(), all.end(),
                     [&](const Said& a, const Said& b) { return place(a) < place(b); });
    return all;
}

void find_rank_defect(const System& system, const Shape& shape, const Covariance& covariance,
                      const Vec3& middle, Diagnosis& diagnosis) {
    diagnosis.rank_defect = covariance.rank_defect();
    if (diagnosis.rank_defect == 0) return;
    const Layout layout = layout_of(shape);
    // A freedom is named when the open directions together may move it by a tenth of what the mesh
    // itself is trusted for.
    for (int f = 0; f < layout.facets; ++f) {
        const auto rows = facet_functions(shape, f, layout, middle);
        static constexpr std::array<const char*, 3> names{"inclination", "azimuth", "offset"};
        const double flat = std::hypot(shape.normals[f].x, shape.normals[f].y);
        for (std::size_t k = 0; k < 3; ++k) {
            if (k == 1 && flat < 1e-9) continue;
            if (std::sqrt(covariance.open_variance(rows[k])) > 0.02) {
                diagnosis.undetermined.push_back({system.stone().solid.facets[f].name, names[k]});
            }
        }
    }
}

// Baarda's data snooping, for several errors at once, and where that is not the whole story the
// smallest set of readings that disagrees.
void snoop(const System& system, const Linearised& linear, const Covariance& covariance,
           const DiagnosisOptions& options, Diagnosis& diagnosis) {
    const std::vector<Said> counted = all_said(linear);
    const Eigen::Index count = static_cast<Eigen::Index>(counted.size());
    // At the optimum the residuals are R times the errors; elsewhere what a step would take away
    // comes off first.
    const Eigen::VectorXd taken = covariance.fitted_part(linear.soft_residuals);
    Residuals residuals;
    residuals.values.resize(count);
    residuals.redundancy.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Said& said = counted[std::size_t(i)];
        residuals.values(i) = said.residual(linear) - said.part * taken(said.equation);
        residuals.redundancy(i) = 1 - said.leverage(covariance);
    }
    residuals.column = [&](Eigen::Index i) {
        const Said& one = counted[std::size_t(i)];
        const Eigen::VectorXd all = covariance.leverage_column(one.equation);
        Eigen::VectorXd column(count);
        for (Eigen::Index k = 0; k < count; ++k) {
            const Said& other = counted[std::size_t(k)];
            column(k) = -one.part * other.part * all(other.equation);
        }
        column(i) = residuals.redundancy(i);
        return column;
    };
    const double pairs = std::max(1.0, 0.5 * double(count) * double(count - 1));
    const Outliers outliers = find_outliers(residuals, diagnosis.suspect_limit,
                                            chi2_quantile(options.significance / pairs, 2),
                                            std::max<std::size_t>(3, counted.size() / 10));
    const auto reading_of = [&](Eigen::Index i) { return counted[std::size_t(i)].reading; };
    diagnosis.throughout = outliers.throughout;
    for (const Outlier& outlier : outliers.found) {
        const int reading = reading_of(outlier.equation);
        if (reading < 0 || diagnosis.readings[std::size_t(reading)].suspect) continue;
        diagnosis.readings[std::size_t(reading)].suspect = true;
        diagnosis.suspects.push_back(reading);
        const Reading& named = system.readings()[std::size_t(reading)];
        const double unit = counted[std::size_t(outlier.equation)].sigma * system.unit_of(named);
        Suspicion suspicion{
            reading, named.value - outlier.error * unit, outlier.error_sigma * unit, {}};
        for (const Eigen::Index other : outlier.alternatives) {
            const int alternative = reading_of(other);
            if (alternative >= 0 && alternative != reading) {
                suspicion.alternatives.push_back(alternative);
            }
        }
        diagnosis.suspicions.push_back(std::move(suspicion));
    }
    if (!(chi2_tail(diagnosis.chi2, diagnosis.dof) < options.significance) || count > 1500) return;
    Eigen::MatrixXd matrix(count, count);
    std::vector<int> owner;
    for (Eigen::Index i = 0; i < count; ++i) {
        matrix.col(i) = residuals.column(i);
        owner.push_back(reading_of(i));
    }
    diagnosis.disagreeing =
        disagreeing_readings(residuals.values, std::move(matrix), owner, options.significance);
}

// Without a covariance: what every reading came to, and nothing of how sure that is.
void residuals_only(const System& system, const Linearised& linear,
                    const std::vector<Said>& counted, Diagnosis& diagnosis) {
    constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();
    diagnosis.analysed = false;
    for (ReadingCheck& c : diagnosis.readings) c.normalized = c.redundancy = k_unknown;
    for (FacetSigma& s : diagnosis.facets) s = {k_unknown, k_unknown, k_unknown, k_unknown};
    const auto note = [&](int reading, double residual) {
        if (reading < 0) return;
        ReadingCheck& c = diagnosis.readings[std::size_t(reading)];
        const double in_units = residual * system.unit_of(system.readings()[std::size_t(reading)]);
        if (std::abs(in_units) > std::abs(c.residual)) c.residual = in_units;
    };
    for (const Said& said : counted) note(said.reading, said.residual(linear) * said.sigma);
    for (std::size_t i = 0; i < linear.hard.size(); ++i) {
        note(linear.hard[i].reading, linear.hard_residuals(Eigen::Index(i)));
    }
    // Bounds by counting: no more redundancy than readings, no fewer open parameters than unknowns
    // that outnumber all equations.
    diagnosis.dof = double(counted.size());
    const Eigen::Index equations = Eigen::Index(counted.size()) + linear.hard_rows.rows() +
                                   Eigen::Index(linear.gauge_rows.size());
    diagnosis.rank_defect =
        static_cast<int>(std::max<Eigen::Index>(0, linear.layout.size() - equations));
}

}  // namespace

Diagnosis diagnose(const System& system, const Shape& shape,
                   const std::shared_ptr<const Outline>& outline, const DiagnosisOptions& options) {
    Diagnosis diagnosis;
    const Linearised linear = linearise(system, shape, outline, false);
    const Layout layout = linear.layout;
    diagnosis.chi2 = linear.chi2();
    diagnosis.readings.resize(system.readings().size());
    diagnosis.facets.resize(shape.normals.size());
    const std::vector<Said> counted = all_said(linear);
    const auto covariance = std::make_shared<const Covariance>(linear);
    if (!covariance->usable()) {
        residuals_only(system, linear, counted, diagnosis);
        return diagnosis;
    }
    diagnosis.dof = options.binding;
    std::vector<double> redundancy(counted.size());
    for (std::size_t i = 0; i < counted.size(); ++i) {
        redundancy[i] = 1 - counted[i].leverage(*covariance);
        if (redundancy[i] < k_no_redundancy) redundancy[i] = 0;
        diagnosis.dof += redundancy[i];
        const Equation& e = linear.soft[std::size_t(counted[i].equation)];
        if (e.group >= 0) {
            const double miss = counted[i].residual(linear) * e.sigma;
            diagnosis.group_squares[std::size_t(e.group)] += miss * miss;
            diagnosis.group_redundancy[std::size_t(e.group)] += redundancy[i];
        }
    }
    if (!options.full) return diagnosis;
    diagnosis.covariance = covariance;

    // Every reading's equations together; the worst of them speaks for the reading.
    diagnosis.suspect_limit = two_sided_normal_quantile(
        options.significance / std::max<double>(1, double(counted.size())));
    std::vector<int> terms(system.readings().size(), 0);
    const auto note = [&](int which, double sigma, double residual, double r, double w) {
        if (which < 0) return;
        const Reading& reading = system.readings()[std::size_t(which)];
        ReadingCheck& c = diagnosis.readings[std::size_t(which)];
        const double unit = system.unit_of(reading);
        if (terms[std::size_t(which)]++ == 0 || std::abs(residual * unit) > std::abs(c.residual)) {
            c.residual = residual * unit;
        }
        if (std::abs(w) > std::abs(c.normalized)) c.normalized = w;
        c.redundancy += r;
        if (r > k_no_redundancy) {
            const double found =
                sigma * unit * (diagnosis.suspect_limit + k_power_80) / std::sqrt(r);
            c.detectable = c.detectable == 0 ? found : std::max(c.detectable, found);
        }
    };
    for (std::size_t i = 0; i < counted.size(); ++i) {
        const Said& said = counted[i];
        const double scaled = said.residual(linear);
        const double w = redundancy[i] > k_no_redundancy ? scaled / std::sqrt(redundancy[i]) : 0;
        note(said.reading, said.sigma, scaled * said.sigma, redundancy[i], w);
    }
    for (std::size_t i = 0; i < linear.hard.size(); ++i) {
        note(linear.hard[i].reading, 1, linear.hard_residuals(Eigen::Index(i)), 0, 0);
    }
    for (std::size_t r = 0; r < terms.size(); ++r) {
        if (terms[r] > 0) diagnosis.readings[r].redundancy /= terms[r];
    }
    if (options.seen_from) {
        const Linearised there =
            linearise(system, options.seen_from->shape, options.seen_from->outline, false);
        const Covariance from_there(there);
        snoop(system, there, from_there.usable() ? from_there : *covariance, options, diagnosis);
    } else {
        snoop(system, linear, *covariance, options, diagnosis);
        if (!diagnosis.suspects.empty() && !options.held.empty()) {
            // What holds a corner bends readings beside it that hardly anything else checks.
            const Linearised there = linearise(system, shape, outline, false, options.held);
            const Covariance from_there(there);
            if (from_there.usable()) {
                for (ReadingCheck& c : diagnosis.readings) c.suspect = false;
                diagnosis.suspects.clear();
                diagnosis.suspicions.clear();
                snoop(system, there, from_there, options, diagnosis);
            }
        }
    }
    if (linear.worst_hard() > k_hard_limit) {
        diagnosis.disagreeing = inconsistent_exact_readings(system, shape, outline);
    }

    const Vec3 middle = middle_of(shape);
    const RowWriter writer(shape);
    // Azimuths are told in the result's frame, which turns to lie as the mesh does.
    const FunctionRow turn = writer.function(system.turn_of(shape));
    const Eigen::VectorXd with_turn = covariance->with_all(turn, true);
    const double turn_variance = turn.dot(with_turn);
    for (int f = 0; f < layout.facets; ++f) {
        const auto rows = facet_functions(shape, f, layout, middle);
        const auto total = [&](std::size_t k) {
            return std::sqrt(covariance->total_variance(rows[k]));
        };
        FacetSigma& sigma = diagnosis.facets[std::size_t(f)];
        sigma.inclination = total(0);
        sigma.offset = total(2);
        const double flat = std::hypot(shape.normals[f].x, shape.normals[f].y);
        sigma.azimuth =
            flat > 1e-9 ? std::sqrt(std::max(0.0, covariance->total_variance(rows[1]) +
                                                      turn_variance + 2 * rows[1].dot(with_turn)))
                        : std::numeric_limits<double>::quiet_NaN();
    }
    if (system.has_prior()) find_parts_read(shape, linear, *covariance, middle, diagnosis);
    for (int f = 0; f < layout.facets; ++f) {
        if (outline->loops[f].size() < 3) continue;
        std::vector<Corner> loop;
        for (int c : outline->loops[f]) loop.push_back(outline->corners[c]);
        const FunctionRow row = writer.function(enclosed_area(loop)(shape));
        diagnosis.facets[std::size_t(f)].area = std::sqrt(covariance->total_variance(row));
    }
    find_rank_defect(system, shape, *covariance, middle, diagnosis);
    return diagnosis;
}

}  // namespace culet
