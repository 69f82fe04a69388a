// The verdict on a fit: its status and why, in one line.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "fit/findings/describe.h"
#include "fit/findings/shape_findings.h"
#include "fit/findings/words.h"
#include "fit/mesh/degenerate_parts.h"
#include "stone/solid/checks.h"

namespace culet {

namespace {

// Promise to the user: corners lie on their planes within this part of the diameter.
constexpr double k_planarity = 1e-12;

struct Judgement {
    FitStatus status = FitStatus::converged;
    std::string message;
};
using MaybeJudgement = std::optional<Judgement>;

MaybeJudgement no_stone(std::string why) {
    return Judgement{FitStatus::not_converged, std::move(why)};
}

struct Fit {
    const FitModel& model;
    const Finished& finished;
    const Diagnosis& diagnosis;
    const FitResult& result;
    double level = result.log.options.significance;
};

std::string told_all(const Fit& fit, const std::vector<std::string>& ids) {
    std::vector<std::string> words;
    for (const std::string& id : ids) words.push_back(told_reading(fit.model.readings(), id));
    return name_list(words);
}

// Names the readings that are probably wrong.
std::string suspect_words(const Fit& fit) {
    if (fit.result.findings.suspects.empty()) {
        if (fit.result.findings.disagreeing.empty()) return {};
        return "; conflicting readings: " + told_all(fit, fit.result.findings.disagreeing);
    }
    const Proposal& first = fit.result.findings.proposals.front();
    std::string text =
        "; look at " + told_all(fit, fit.result.findings.suspects) + slip_words(first);
    if (first.slip.empty() && !first.alternatives.empty()) {
        text += " (or at " + told_all(fit, first.alternatives) + " instead)";
    }
    return text;
}

MaybeJudgement exact_contradiction(const Fit& fit) {
    std::vector<std::string> broken;
    for (std::size_t r = 0; r < fit.model.readings().size(); ++r) {
        const Reading& reading = fit.model.readings()[r];
        const double limit = k_hard_limit * fit.model.frame().unit_of(reading);
        if (reading.exact && std::abs(fit.diagnosis.readings[r].residual) > limit) {
            broken.push_back(reading.id);
        }
    }
    if (broken.empty()) return {};
    return Judgement{
        FitStatus::contradictory,
        "exact readings contradict each other: " +
            name_list(fit.result.findings.disagreeing.empty() ? broken
                                                              : fit.result.findings.disagreeing)};
}

// Names degenerate facets and edges.
std::string in_the_way(const Solid& solid) {
    const DegenerateParts degenerate = degenerate_parts(solid);
    std::string text;
    if (!degenerate.facets.empty()) {
        text = fmt::format(
            ": nothing is left of {}; read how large they are, leave them out of the mesh, or use "
            "--allow-topology",
            name_list(degenerate.facets));
    }
    if (!degenerate.edges.empty()) {
        text += fmt::format("{} {} lie in one plane; draw each two as one facet",
                            text.empty() ? ":" : ";", name_list(degenerate.edges));
    }
    return text;
}

MaybeJudgement denied_topology(const Fit& fit) {
    if (!fit.result.checks.missing_facets.empty()) {
        return no_stone("the fitted planes leave no room for facet " +
                        name_list(fit.result.checks.missing_facets));
    }
    for (const ShapeFinding& f : fit.result.findings.shapes) {
        if (f.kind == ShapeFinding::Kind::facet_vanishes) {
            return no_stone(f.what + "; leave it out of the mesh, or use --allow-topology");
        }
    }
    if (fit.finished.worst_hard > k_hard_limit) {
        return no_stone("the facets and meets could not be brought together" +
                        in_the_way(fit.result.solid));
    }
    if (!are_edges_denied(fit.result)) return {};
    return no_stone(fmt::format(
        "by the readings these neighbours in the mesh do not touch: {} (with the edge between them "
        "chi-square is larger by {:.1f}); draw the ends of the edge as one corner, or use "
        "--allow-topology",
        name_list(fit.result.findings.vanishing_edges), fit.result.findings.vanishing_chi2));
}

MaybeJudgement unsound_solid(const Fit& fit) {
    const bool must_be_convex = fit.model.stone().convex;
    const SolidChecks& checks = fit.result.checks;
    const std::string unsound = !checks.closed                     ? "closed"
                                : must_be_convex && !checks.convex ? "convex"
                                                                   : "";
    if (!must_be_convex || !unsound.empty()) {
        const std::vector<Fault> faults = find_faults(
            fit.result.solid, {.planarity = k_planarity, .must_be_convex = must_be_convex});
        if (!unsound.empty() || !faults.empty()) {
            return no_stone("the fitted stone is not " + (unsound.empty() ? "sound" : unsound) +
                            (faults.empty() ? "" : ": " + faults.front().what));
        }
    }
    if (checks.planarity_max >
        std::max(k_planarity * diameter(fit.result.solid), coordinate_rounding(fit.result.solid))) {
        return no_stone(fmt::format("corners lie up to {:.2g} {} off their facets' planes",
                                    checks.planarity_max, name_of(fit.result.unit)));
    }
    return {};
}

MaybeJudgement unsettled(const Fit& fit) {
    // Before convergence, because steps creep next to an edge without length.
    for (const ShapeFinding& f : fit.result.findings.shapes) {
        if (f.kind == ShapeFinding::Kind::edge_vanishes && f.p < fit.level) {
            return Judgement{FitStatus::contradictory, f.what + "; use --allow-topology"};
        }
    }
    if (fit.finished.converged) return {};
    return no_stone(
        fmt::format("the fit did not converge in {} steps: the readings hardly determine some part "
                    "of the stone; check the suspects, read more, or give [fit] a prior",
                    fit.finished.iterations));
}

MaybeJudgement disagreement(const Fit& fit) {
    const FitStatistics& statistics = fit.result.statistics;
    if (statistics.dof > 0 && statistics.chi2_p < fit.level) {
        return Judgement{
            FitStatus::contradictory,
            fmt::format("the readings do not agree within their uncertainties (chi-square {:.1f}; "
                        "{:.1f} expected; above {:.1f} in {:g} of cases){}",
                        statistics.chi2, statistics.dof, statistics.chi2_limit, fit.level,
                        suspect_words(fit))};
    }
    if (fit.result.findings.suspects.empty()) return {};
    return Judgement{FitStatus::contradictory,
                     "readings that disagree with the others" + suspect_words(fit)};
}

MaybeJudgement undetermined(const Fit& fit) {
    if (fit.result.statistics.rank_defect <= 0) return {};
    std::set<std::string> facets;
    for (const Undetermined& u : fit.result.findings.undetermined) facets.insert(u.facet);
    return Judgement{
        FitStatus::undetermined,
        fmt::format("too little was read to fix the whole stone: {} of its {} facets {} as in "
                    "the mesh{}; {}",
                    facets.size(), fit.result.facets.size(), facets.size() == 1 ? "is" : "are",
                    facets.empty() ? "" : " (" + name_list({facets.begin(), facets.end()}) + ")",
                    fit.result.findings.help.empty()
                        ? "a prior would fill it in ([fit] prior = \"mesh\")"
                        : "next, " + bench_words(fit.result.findings.help[0]))};
}

// Outlines and relations have no value that somebody may have copied.
bool has_measured_value(const FitModel& model) {
    return std::any_of(model.readings().begin(), model.readings().end(),
                       [](const Reading& r) { return r.is_measured(); });
}

// The lower tail of chi-square. Not with a prior, where readings count with more than their sigmas
// (count_beside_prior).
std::string too_good(const Fit& fit) {
    const FitStatistics& statistics = fit.result.statistics;
    if (fit.result.log.options.prior.source != Prior::Source::none) return {};
    if (!has_measured_value(fit.model)) return {};
    if (!(statistics.dof > 0) || !(statistics.chi2_low_p < fit.level)) return {};
    constexpr double k_exactly = 1e6;
    const double times = std::sqrt(statistics.dof / std::max(statistics.chi2, 1e-300));
    return fmt::format(
        "the readings agree {}: the sigmas are too large, or values were copied or computed "
        "(chi-square {:.3g} where {:.0f} is expected; by chance less often than once in {:.0f} "
        "times)",
        times < k_exactly ? fmt::format("{:.2g} times better than their sigmas allow", times)
                          : "exactly, which their sigmas make unlikely",
        statistics.chi2, statistics.dof, 1 / fit.level);
}

// The most serious first: later ones mean nothing beside an earlier one.
Judgement verdict_on(const Fit& fit) {
    for (const auto& verdict : {exact_contradiction, denied_topology, unsound_solid, unsettled,
                                disagreement, undetermined}) {
        if (MaybeJudgement found = verdict(fit)) return *found;
    }
    return {
        FitStatus::converged,
        fmt::format("the readings agree within their sigmas (chi-square {:.1f}, {:.0f} expected)",
                    fit.result.statistics.chi2, fit.result.statistics.dof)};
}

}  // namespace

void judge(const FitModel& model, const Finished& finished, const Diagnosis& diagnosis,
           FitResult& result) {
    const Fit fit{model, finished, diagnosis, result};
    const Judgement verdict = verdict_on(fit);
    const bool stands = verdict.status != FitStatus::not_converged;
    const std::string note = stands ? too_good(fit) : "";
    if (!note.empty()) result.log.notes.push_back(note);
    result.status = verdict.status;
    result.message = verdict.message;
    if (!result.findings.vanishing_edges.empty() && stands) {
        result.message += fmt::format(
            "; by the readings these neighbours hardly touch: {} (their edge is kept, without "
            "length)",
            name_list(result.findings.vanishing_edges));
    }
    for (const std::string& one : result.log.notes) result.message += "; " + one;
    if (!diagnosis.analysed) {
        result.message += "; too many facets for uncertainties and suspects: none are given";
    }
}

}  // namespace culet
