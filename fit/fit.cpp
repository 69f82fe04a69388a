#include "fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/assess.h"
#include "fit/describe.h"
#include "fit/diagnostics.h"
#include "fit/find_symmetry.h"
#include "fit/finish.h"
#include "fit/mending.h"
#include "fit/portfolio.h"
#include "fit/refit.h"
#include "fit/robust.h"
#include "fit/statistics.h"
#include "fit/system.h"
#include "fit/topology.h"
#include "stone/checks.h"
#include "stone/errors.h"

namespace culet {

const char* name_of(FitStatus status) {
    switch (status) {
        case FitStatus::converged:
            return "converged";
        case FitStatus::not_converged:
            return "not_converged";
        case FitStatus::contradictory:
            return "contradictory";
        case FitStatus::undetermined:
            return "undetermined";
    }
    return "not_converged";
}

namespace {

// What is left of hard equations after the last stage is rounding; an exact reading that misses by
// more than this part of the half diameter contradicts another.
constexpr double k_hard_limit = 1e-9;
// Contract with the user: corners lie on their planes to this part of the diameter.
constexpr double k_planarity = 1e-9;

// Foerstner (1979): each group's uncertainty is the one that its residuals show, sum of squares /
// redundancy, repeated until it agrees with the one they were weighted by.
void estimate_sigmas(System& system, Finished& finished, const FitOptions& options,
                     const Progress& progress) {
    for (int round = 0; round < 60; ++round) {
        if (progress && !progress(0.7 + 0.004 * round)) throw Interrupted();
        const Diagnosis d = diagnose(system, finished.shape, finished.outline, {.full = false});
        double largest = 0;
        for (std::size_t g = 0; g < d.group_squares.size(); ++g) {
            if (!(d.group_redundancy[g] > 0.5)) continue;
            const double before = system.group_sigmas()[g];
            const double change =
                0.5 * std::log(std::max(1e-30, d.group_squares[g]) / d.group_redundancy[g]) -
                std::log(before);
            largest = std::max(largest, std::abs(change));
            // Rounding is the least that anything can miss by.
            system.set_group_sigma(
                static_cast<int>(g),
                std::max(1e-9, before * std::exp(std::clamp(change, -2.0, 2.0))));
        }
        // One per cent of an uncertainty is more than its estimate is worth. Before that, the
        // weights move again before the steps would end.
        const bool settled = largest < 1e-2;
        const int steps = finished.iterations;
        finished = finish(system, finished.shape, settled ? options.iterations : 3);
        finished.iterations += steps;
        if (settled) return;
    }
    const int steps = finished.iterations;
    finished = finish(system, finished.shape, options.iterations);
    finished.iterations += steps;
}

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
        result.meets.miss_max = std::max(result.meets.miss_max, miss);
    }
    for (int h : how) {
        ++(h == 0 ? result.meets.exact : h == 1 ? result.meets.soft : result.meets.released);
    }
    if (count > 0) result.meets.miss_rms = std::sqrt(squares / count);
    if (system.has_common_meets()) {
        result.meets.sigma = system.group_sigmas()[0] * system.scale();
        result.meets.girdle_sigma = system.group_sigmas()[1] * system.scale();
        result.meets.estimated = !result.options.meet_sigma;
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

std::string names(const std::vector<std::string>& list) {
    std::string text;
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (i == 8) return text + fmt::format(" and {} more", list.size() - i);
        text += (i == 0 ? "" : ", ") + list[i];
    }
    return text;
}

// A gross error: beyond this the equations' bend matters.
bool needs_robust_view(const Diagnosis& diagnosis) {
    return std::any_of(diagnosis.readings.begin(), diagnosis.readings.end(),
                       [](const ReadingCheck& c) { return std::abs(c.normalized) > 8; });
}

std::string words(const NextReading& reading) {
    std::string of;
    for (const std::string& name : reading.of) of += (of.empty() ? "" : "/") + name;
    return name_of(reading.kind) + (of.empty() ? "" : " of " + of);
}

// Who is to blame, as far as one can tell.
std::string contradiction(const FitResult& result) {
    std::string text;
    if (!result.suspects.empty()) {
        text = "; look at " + names(result.suspects);
        const Proposal& first = result.proposals.front();
        if (!first.slip.empty()) {
            text += fmt::format(" ({}: {:g}?)", first.slip,
                                first.in_radians ? degrees(first.corrected) : first.corrected);
        } else if (!first.alternatives.empty()) {
            text += " (or at " + names(first.alternatives) + " instead)";
        }
    } else if (!result.disagreeing.empty()) {
        text = "; the fewest that cannot hold together: " + names(result.disagreeing);
    }
    return text;
}

// The edges whose turning over held corners prevent.
std::vector<std::string> vanishing(const System& system, const std::vector<Held>& held) {
    const std::vector<Facet>& facets = system.stone().solid.facets;
    std::vector<std::string> edges;
    for (const Held& h : held) {
        const std::vector<int>& loop = facets[h.facet].corners;
        for (const Edge& e : system.edges().edges) {
            const int other = e.from == h.point ? e.to : e.to == h.point ? e.from : -1;
            if (other < 0 || std::find(loop.begin(), loop.end(), other) == loop.end()) continue;
            std::string name = facets[e.left].name + "/" + facets[e.right].name;
            if (std::find(edges.begin(), edges.end(), name) == edges.end()) {
                edges.push_back(std::move(name));
            }
        }
    }
    return edges;
}

// The mesh was drawn in another unit, most likely.
std::string other_size(const System& system) {
    const double factor = system.mesh_scale(), apart = std::max(factor, 1 / factor);
    if (apart < 3) return {};
    std::string guess;
    for (double known : {10.0, 25.4, 100.0, 1000.0}) {
        if (apart > known / 1.6 && apart < known * 1.6) guess = fmt::format("{:g} ", known);
    }
    return fmt::format(
        "the mesh is {} times too {} for the lengths that were read{}: it was scaled; check `unit` "
        "of [stone]",
        guess.empty() ? fmt::format("{:.3g}", apart) : "about " + guess.substr(0, guess.size() - 1),
        factor > 1 ? "small" : "large", guess.empty() ? "" : ", as if drawn in another unit");
}

void judge(const System& system, const Finished& finished, const Diagnosis& diagnosis,
           FitResult& result) {
    std::vector<std::string> broken;
    for (std::size_t r = 0; r < system.readings().size(); ++r) {
        const Reading& reading = system.readings()[r];
        const double unit = system.unit_of(reading);
        if (reading.exact && std::abs(diagnosis.readings[r].residual) > 10 * k_hard_limit * unit) {
            broken.push_back(reading.id);
        }
    }
    const auto end = [&](FitStatus status, std::string message) {
        result.status = status;
        result.message = std::move(message);
        if (!result.vanishing_edges.empty() && status != FitStatus::not_converged) {
            result.message += fmt::format("; the readings want edge {} to have no length",
                                          names(result.vanishing_edges));
        }
        for (const std::string& note : result.notes) result.message += "; " + note;
        if (!diagnosis.analysed) {
            result.message +=
                "; the stone is too large for uncertainties and suspects: none are given";
        }
    };
    if (!broken.empty()) {
        return end(FitStatus::contradictory,
                   fmt::format("exact readings contradict each other: {}",
                               names(result.disagreeing.empty() ? broken : result.disagreeing)));
    }
    if (!result.missing_facets.empty()) {
        return end(FitStatus::not_converged,
                   fmt::format("the fitted planes leave no room for facet {}",
                               names(result.missing_facets)));
    }
    for (const ShapeFinding& f : result.shape_findings) {
        if (f.kind == ShapeFinding::Kind::facet_vanishes) {
            return end(FitStatus::not_converged,
                       f.what + "; leave it out of the mesh, or allow the topology to change");
        }
    }
    if (finished.worst_hard > k_hard_limit) {
        return end(FitStatus::not_converged, "the facets and meets could not be brought together");
    }
    // Under the hypothesis that an edge has a length at all, chi-square with one freedom for each.
    if (!result.vanishing_edges.empty() &&
        chi2_tail(result.vanishing_chi2, double(result.vanishing_edges.size())) <
            result.options.significance) {
        return end(FitStatus::not_converged,
                   fmt::format("the readings want edge {} to have no length, and agree with the "
                               "mesh's facets only at a loss (chi2 {:.1f} more)",
                               names(result.vanishing_edges), result.vanishing_chi2));
    }
    if (!system.stone().convex) {
        const std::vector<Fault> faults =
            find_faults(result.solid, {.planarity = k_planarity, .must_be_convex = false});
        if (!faults.empty()) {
            return end(FitStatus::not_converged,
                       "the fitted stone is not sound: " + faults.front().what);
        }
    }
    if (!result.closed || (!result.convex && system.stone().convex)) {
        const std::vector<Fault> faults = find_faults(
            result.solid, {.planarity = k_planarity, .must_be_convex = system.stone().convex});
        return end(FitStatus::not_converged,
                   fmt::format("the fitted stone is not {}{}", result.closed ? "convex" : "closed",
                               faults.empty() ? "" : ": " + faults.front().what));
    }
    if (result.planarity_max >
        std::max(k_planarity * diameter(result.solid), coordinate_rounding(result.solid))) {
        return end(FitStatus::not_converged,
                   fmt::format("corners lie up to {:.2g} {} off their facets' planes",
                               result.planarity_max, name_of(result.unit)));
    }
    // Before the steps: next to an edge that has no length they creep.
    for (const ShapeFinding& f : result.shape_findings) {
        if (f.kind == ShapeFinding::Kind::edge_vanishes && f.p < result.options.significance) {
            return end(FitStatus::contradictory, f.what + "; allow the topology to change");
        }
    }
    if (!finished.converged) {
        return end(FitStatus::not_converged,
                   fmt::format("no end after {} steps; raise the limit, or look at the suspects",
                               finished.iterations));
    }
    if (result.dof > 0 && result.chi2_p < result.options.significance) {
        return end(FitStatus::contradictory,
                   fmt::format("the readings do not agree within their uncertainties: chi2 {:.1f} "
                               "for {:.1f} degrees of freedom (limit {:.1f} at the {:g} level){}",
                               result.chi2, result.dof, result.chi2_limit,
                               result.options.significance, contradiction(result)));
    }
    if (!result.suspects.empty()) {
        return end(FitStatus::contradictory,
                   "readings that cannot belong to the others" + contradiction(result));
    }
    if (result.undetermined_freedoms > 0) {
        std::vector<std::string> facets;
        for (const Undetermined& u : result.undetermined) {
            if (facets.empty() || facets.back() != u.facet) facets.push_back(u.facet);
        }
        return end(FitStatus::undetermined,
                   fmt::format("{} of the stone {} left as in the mesh, for want of readings{}",
                               result.undetermined_freedoms == 1
                                   ? std::string("one freedom")
                                   : fmt::format("{} freedoms", result.undetermined_freedoms),
                               result.undetermined_freedoms == 1 ? "is" : "are",
                               facets.empty() ? "" : " (facets " + names(facets) + ")") +
                       (result.help.empty() ? "" : "; most would help: " + words(result.help[0])));
    }
    end(FitStatus::converged,
        fmt::format("chi2 {:.1f} for {:.1f} degrees of freedom", result.chi2, result.dof));
}

}  // namespace

FitResult fit_stone(const Stone& drawn, const std::vector<Reading>& readings,
                    const FitOptions& options, const Progress& progress) {
    const auto begin = std::chrono::steady_clock::now();
    const std::optional<Stone> mirrored = mirrored_to_azimuths(drawn, readings);
    const Stone& stone = mirrored ? *mirrored : drawn;
    System system(stone, readings, options);
    FitResult result;
    result.options = options;
    if (options.allow_topology) result.options.findings = true;
    result.unit = stone.unit;

    std::optional<Candidate> again;
    if (const auto shape = options.start ? shape_of(system, *options.start) : std::nullopt) {
        again = finish_from(system, *shape, options.iterations);
    }
    const bool goes_on = again && again->sound && again->finished.converged &&
                         again->finished.worst_hard < k_hard_limit;
    Portfolio portfolio;
    if (goes_on) {
        portfolio.best = std::move(*again);
        portfolio.best.start = "earlier result";
    } else {
        portfolio = fit_from_starts(system, options, progress);
    }
    Candidate& best = portfolio.best;
    const std::vector<double> weights =
        options.loss == Loss::none ? std::vector<double>()
                                   : reweight(system, best, options.loss, options.iterations);
    result.starts = portfolio.starts;
    result.start = best.start;
    result.vanishing_edges = vanishing(system, best.held);
    result.vanishing_chi2 = best.cost_of_holding;
    if (mirrored) {
        result.notes.push_back(
            "by the azimuths read, the mesh is the mirror image of the stone: it was mirrored");
    }
    if (const std::string note = other_size(system); !note.empty()) result.notes.push_back(note);
    if (progress && !progress(0.7)) throw Interrupted();
    if (system.has_estimated_groups()) {
        estimate_sigmas(system, best.finished, options, progress);
    }
    if (progress && !progress(0.95)) throw Interrupted();

    const Finished& finished = best.finished;
    const Diagnosis diagnosis = [&] {
        Diagnosis plain = diagnose(system, finished.shape, finished.outline,
                                   {.significance = options.significance});
        if (!needs_robust_view(plain) || options.loss != Loss::none) return plain;
        // A gross error bends the whole stone: look for it from a fit that it does not pull.
        System reweighted = system;
        Candidate robust = best;
        reweight(reweighted, robust, Loss::cauchy, options.iterations);
        if (!robust.sound || !robust.finished.outline) return plain;
        return diagnose(system, finished.shape, finished.outline,
                        {.significance = options.significance, .seen_from = &robust.finished});
    }();
    const System::Pose pose = system.pose_of(finished.shape);
    result.missing_facets = make_solid(system, finished.shape, pose, result);
    result.planarity_max = planarity(result.solid);
    result.closed = is_closed(result.solid);
    result.convex = is_convex(result.solid);
    result.azimuth_zero = system.azimuth_zero(pose);
    result.iterations = finished.iterations;
    result.chi2 = diagnosis.chi2;
    result.dof = diagnosis.dof;
    result.chi2_p = chi2_tail(diagnosis.chi2, diagnosis.dof);
    result.chi2_limit = chi2_quantile(options.significance, diagnosis.dof);
    result.suspect_limit = diagnosis.suspect_limit;
    result.undetermined = diagnosis.undetermined;
    result.undetermined_freedoms = diagnosis.undetermined_freedoms;
    describe_meets(system, finished.shape, result);

    for (std::size_t f = 0; f < stone.solid.facets.size(); ++f) {
        FittedFacet facet;
        facet.name = stone.solid.facets[f].name;
        const Vec3& n = finished.shape.normals[f];
        facet.plane = system.outside_plane({n, finished.shape.offsets[f]}, pose);
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
        const int there = find_facet(result.solid, facet.name);
        if (there >= 0) facet.area = area(result.solid, result.solid.facets[there]);
        facet.sigma_area = sigma.area * system.scale() * system.scale();
        result.facets.push_back(std::move(facet));
    }
    for (std::size_t r = 0; r < readings.size(); ++r) {
        const Reading& reading = readings[r];
        const ReadingCheck& c = diagnosis.readings[r];
        FittedReading fitted;
        fitted.id = reading.id;
        fitted.kind = reading.kind;
        fitted.of = reading.of;
        fitted.value = reading.value;
        fitted.sigma = reading.sigma;
        if (is_relation(reading.kind) && reading.sigma == 0 && !reading.exact) {
            fitted.sigma = reading.released ? 0 : system.group_sigmas()[0] * system.scale();
        }
        fitted.fitted = reading.value + c.residual;
        fitted.residual = c.residual;
        fitted.normalized = c.normalized;
        fitted.redundancy = c.redundancy;
        fitted.detectable = c.detectable;
        fitted.suspect = c.suspect;
        fitted.exact = reading.exact;
        fitted.rounding = reading.rounding;
        if (!weights.empty()) fitted.weight = weights[r];
        result.readings.push_back(std::move(fitted));
    }
    for (int s : diagnosis.suspects) result.suspects.push_back(readings[s].id);
    assess(system, finished, diagnosis, result);
    std::vector<HeldCorner> held;
    for (const Held& h : best.held) held.push_back({h.facet, h.point});
    describe_findings(system, finished, held, diagnosis, pose, result);
    const auto declares = [](const Reading& r) {
        return r.kind == ReadingKind::rotation || r.kind == ReadingKind::mirror;
    };
    if (options.find_symmetry && std::any_of(readings.begin(), readings.end(), declares)) {
        result.symmetry = find_symmetry(stone, readings, options, progress);
    }
    judge(system, finished, diagnosis, result);
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (options.allow_topology) {
        result = fit_with_changes(stone, readings, options, std::move(result), progress);
        result.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    if (progress) progress(1);
    return result;
}

}  // namespace culet
