#include "fit/findings/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <set>

#include "fit/findings/bench_words.h"
#include "fit/findings/name_list.h"
#include "fit/mesh/come_to_nothing.h"
#include "fit/uncertainty/statistics.h"
#include "stone/checks.h"

namespace culet {

namespace {

// Contract with the user: corners lie on their planes to this part of the diameter.
constexpr double k_planarity = 1e-12;

std::string told_all(const System& system, const std::vector<std::string>& ids) {
    std::vector<std::string> words;
    for (const std::string& id : ids) words.push_back(told_reading(system.readings(), id));
    return name_list(words);
}

// Who is to blame, as far as one can tell.
std::string contradiction(const System& system, const FitResult& result) {
    std::string text;
    if (!result.findings.suspects.empty()) {
        text = "; look at " + told_all(system, result.findings.suspects);
        const Proposal& first = result.findings.proposals.front();
        if (!first.slip.empty()) {
            text += fmt::format(" ({}: {:g}?)", first.slip,
                                first.in_radians ? degrees(first.corrected) : first.corrected);
        } else if (!first.alternatives.empty()) {
            text += " (or at " + told_all(system, first.alternatives) + " instead)";
        }
    } else if (!result.findings.disagreeing.empty()) {
        text = "; readings that cannot hold together: " +
               told_all(system, result.findings.disagreeing);
    }
    return text;
}

// Next to an edge that the readings leave next to no length the steps creep.
std::string shortest_edge(const System& system, const Shape& shape, LengthUnit unit) {
    constexpr double k_no_length = 2e-3;  // of the half diameter
    const Edge* shortest = nullptr;
    double least = k_no_length;
    for (const Edge& edge : system.edges().edges) {
        const double length =
            glm::length(shape.points[std::size_t(edge.from)] - shape.points[std::size_t(edge.to)]);
        if (!(length < least)) continue;
        least = length;
        shortest = &edge;
    }
    if (shortest == nullptr || system.splits()) return {};
    const std::vector<Facet>& facets = system.stone().solid.facets;
    std::string ends;
    for (const int end : {shortest->from, shortest->to}) {
        for (const int f : system.edges().facets_of_vertex[std::size_t(end)]) {
            if (f == shortest->left || f == shortest->right) continue;
            ends += (ends.empty() ? "" : ", ") + facets[std::size_t(f)].name;
        }
    }
    return fmt::format(
        "edge {}|{} (between {}) has come down to {:.2g} {}, where steps creep; draw its ends as "
        "one corner, or allow the topology to change",
        facets[std::size_t(shortest->left)].name, facets[std::size_t(shortest->right)].name, ends,
        least * system.scale(), name_of(unit));
}

std::string in_the_way(const Solid& solid) {
    const ComeToNothing come = come_to_nothing(solid);
    std::string text;
    if (!come.facets.empty()) {
        text = fmt::format(
            ": nothing is left of {}; read how large they are, leave them out of the mesh, or "
            "allow the topology to change",
            name_list(come.facets));
    }
    if (!come.edges.empty()) {
        text += fmt::format("{} {} lie in one plane; draw each two as one facet",
                            text.empty() ? ":" : ";", name_list(come.edges));
    }
    return text;
}

struct Verdict {
    FitStatus status = FitStatus::converged;
    std::string message;
};

std::optional<Verdict> exact_contradiction(const System& system, const Diagnosis& diagnosis,
                                           const FitResult& result) {
    std::vector<std::string> broken;
    for (std::size_t r = 0; r < system.readings().size(); ++r) {
        const Reading& reading = system.readings()[r];
        const double unit = system.unit_of(reading);
        if (reading.exact && std::abs(diagnosis.readings[r].residual) > k_hard_limit * unit) {
            broken.push_back(reading.id);
        }
    }
    if (broken.empty()) return {};
    return Verdict{
        FitStatus::contradictory,
        fmt::format(
            "exact readings contradict each other: {}",
            name_list(result.findings.disagreeing.empty() ? broken : result.findings.disagreeing))};
}

// No stone has the mesh's facets, edges and meets and these readings.
std::optional<Verdict> denied_topology(const Finished& finished, const FitResult& result) {
    const FitFindings& findings = result.findings;
    if (!result.checks.missing_facets.empty()) {
        return Verdict{FitStatus::not_converged,
                       fmt::format("the fitted planes leave no room for facet {}",
                                   name_list(result.checks.missing_facets))};
    }
    for (const ShapeFinding& f : findings.shapes) {
        if (f.kind == ShapeFinding::Kind::facet_vanishes) {
            return Verdict{FitStatus::not_converged,
                           f.what + "; leave it out of the mesh, or allow the topology to change"};
        }
    }
    if (finished.worst_hard > k_hard_limit) {
        return Verdict{
            FitStatus::not_converged,
            "the facets and meets could not be brought together" + in_the_way(result.solid)};
    }
    // Under the hypothesis that an edge has a length at all, chi-square with one freedom for each.
    if (!findings.vanishing_edges.empty() &&
        chi2_tail(findings.vanishing_chi2, double(findings.vanishing_edges.size())) <
            result.log.options.significance) {
        return Verdict{
            FitStatus::not_converged,
            fmt::format("by the readings these neighbours in the mesh do not touch: {} (with the "
                        "edge between them chi-square is larger by {:.1f}); draw the ends of the "
                        "edge as one corner, or allow the topology to change",
                        name_list(findings.vanishing_edges), findings.vanishing_chi2)};
    }
    return {};
}

std::optional<Verdict> unsound_solid(const System& system, const FitResult& result) {
    if (!system.stone().convex) {
        const std::vector<Fault> faults =
            find_faults(result.solid, {.planarity = k_planarity, .must_be_convex = false});
        if (!faults.empty()) {
            return Verdict{FitStatus::not_converged,
                           "the fitted stone is not sound: " + faults.front().what};
        }
    }
    if (!result.checks.closed || (!result.checks.convex && system.stone().convex)) {
        const std::vector<Fault> faults = find_faults(
            result.solid, {.planarity = k_planarity, .must_be_convex = system.stone().convex});
        return Verdict{
            FitStatus::not_converged,
            fmt::format("the fitted stone is not {}{}", result.checks.closed ? "convex" : "closed",
                        faults.empty() ? "" : ": " + faults.front().what)};
    }
    if (result.checks.planarity_max >
        std::max(k_planarity * diameter(result.solid), coordinate_rounding(result.solid))) {
        return Verdict{FitStatus::not_converged,
                       fmt::format("corners lie up to {:.2g} {} off their facets' planes",
                                   result.checks.planarity_max, name_of(result.unit))};
    }
    return {};
}

std::optional<Verdict> unsettled(const System& system, const Finished& finished,
                                 const FitResult& result) {
    // Before the steps: next to an edge that has no length they creep.
    for (const ShapeFinding& f : result.findings.shapes) {
        if (f.kind == ShapeFinding::Kind::edge_vanishes && f.p < result.log.options.significance) {
            return Verdict{FitStatus::contradictory, f.what + "; allow the topology to change"};
        }
    }
    if (finished.converged) return {};
    const std::string edge = shortest_edge(system, finished.shape, result.unit);
    return Verdict{
        FitStatus::not_converged,
        edge.empty()
            ? fmt::format("the fit does not settle ({} steps): some part of the stone is "
                          "hardly held by the readings; look at the suspects, read more, "
                          "or give [fit] a prior",
                          finished.iterations)
            : fmt::format("the fit does not settle ({} steps): {}", finished.iterations, edge)};
}

std::optional<Verdict> disagreement(const System& system, const FitResult& result) {
    const FitStatistics& statistics = result.statistics;
    if (statistics.dof > 0 && statistics.chi2_p < result.log.options.significance) {
        return Verdict{
            FitStatus::contradictory,
            fmt::format("the readings do not agree within their uncertainties (chi-square "
                        "{:.1f}, {:.1f} expected, at most {:.1f} at the {:g} level){}",
                        statistics.chi2, statistics.dof, statistics.chi2_limit,
                        result.log.options.significance, contradiction(system, result))};
    }
    if (!result.findings.suspects.empty()) {
        return Verdict{FitStatus::contradictory,
                       "readings that cannot belong to the others" + contradiction(system, result)};
    }
    return {};
}

std::optional<Verdict> undetermined(const FitResult& result) {
    if (result.statistics.rank_defect <= 0) return {};
    std::set<std::string> facets;
    for (const Undetermined& u : result.findings.undetermined) facets.insert(u.facet);
    return Verdict{
        FitStatus::undetermined,
        fmt::format("too little was read to fix the whole stone: {} of its {} facets {} as in "
                    "the mesh{}; {}",
                    facets.size(), result.facets.size(), facets.size() == 1 ? "is" : "are",
                    facets.empty() ? "" : " (" + name_list({facets.begin(), facets.end()}) + ")",
                    result.findings.help.empty()
                        ? "a prior would fill it in ([fit] prior = \"mesh\")"
                        : "next, " + bench_words(result.findings.help[0]))};
}

// Readings that agree better than their sigmas allow: the lower tail of chi-square.
std::string too_good(const FitResult& result) {
    const FitStatistics& statistics = result.statistics;
    const double level = result.log.options.significance;
    // Beside a prior readings count with more than their sigmas (count_beside_prior).
    if (result.log.options.prior.source != Prior::Source::none) return {};
    if (!(statistics.dof > 0) || !(statistics.chi2_low_p < level)) return {};
    constexpr double k_exactly = 1e6;
    const double times = std::sqrt(statistics.dof / std::max(statistics.chi2, 1e-300));
    return fmt::format(
        "the readings agree {} (a chi-square of {:.3g} or less, where {:.0f} is expected, comes by "
        "chance less often than once in {:.0f} times): the sigmas are too large, or values were "
        "copied or computed",
        times < k_exactly ? fmt::format("{:.2g} times better than their sigmas allow", times)
                          : "exactly, as their sigmas do not allow",
        statistics.chi2, statistics.dof, 1 / level);
}

// The gravest first: what comes later means nothing where an earlier one holds.
Verdict verdict_on(const System& system, const Finished& finished, const Diagnosis& diagnosis,
                   const FitResult& result) {
    if (auto verdict = exact_contradiction(system, diagnosis, result)) return *verdict;
    if (auto verdict = denied_topology(finished, result)) return *verdict;
    if (auto verdict = unsound_solid(system, result)) return *verdict;
    if (auto verdict = unsettled(system, finished, result)) return *verdict;
    if (auto verdict = disagreement(system, result)) return *verdict;
    if (auto verdict = undetermined(result)) return *verdict;
    return {
        FitStatus::converged,
        fmt::format("the readings agree within their sigmas (chi-square {:.1f}, {:.0f} expected)",
                    result.statistics.chi2, result.statistics.dof)};
}

}  // namespace

void judge(const System& system, const Finished& finished, const Diagnosis& diagnosis,
           FitResult& result) {
    const Verdict verdict = verdict_on(system, finished, diagnosis, result);
    result.status = verdict.status;
    result.message = verdict.message;
    if (result.status != FitStatus::not_converged) {
        if (std::string note = too_good(result); !note.empty()) {
            result.log.notes.push_back(std::move(note));
        }
    }
    if (!result.findings.vanishing_edges.empty() && verdict.status != FitStatus::not_converged) {
        result.message += fmt::format(
            "; by the readings these neighbours hardly touch: {} (their edge is kept, without "
            "length)",
            name_list(result.findings.vanishing_edges));
    }
    for (const std::string& note : result.log.notes) result.message += "; " + note;
    if (!diagnosis.analysed) {
        result.message += "; the stone is too large for uncertainties and suspects: none are given";
    }
}

}  // namespace culet
