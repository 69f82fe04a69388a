#include "fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "fit/attempt.h"
#include "fit/findings/symmetry_tests.h"
#include "fit/findings/tier_findings.h"
#include "fit/hypotheses/hypotheses.h"
#include "fit/hypotheses/preparations.h"
#include "fit/hypotheses/topology.h"
#include "fit/mesh/repair.h"
#include "fit/take_outlines.h"
#include "fit/uncertainty/prior_needed.h"
#include "stone/progress/check_stop.h"
#include "stone/text/errors.h"

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

FitResult solved(const Problem& given, std::span<const Hypothesis> hypotheses,
                 const Progress& progress);

// Compares by one measure: chi-square of the problem as given and as changed.
void say_what_changed(const std::string& what, const FitResult& given, FitResult& result) {
    if (what.empty()) return;
    const double before = given.statistics.chi2, after = result.statistics.chi2;
    const std::string note =
        fmt::format("with everything as given, chi-square is {:.1f}; with this change ({}) {:.1f}",
                    before, what, after);
    result.log.changed.push_back({what, result.message, before, after, "chi-square"});
    result.log.notes.push_back(note);
    result.message += "; " + note;
}

// Returns the result under the first hypothesis that explains what the first attempt does not. Each
// hypothesis is tried together with those after it in the list.
std::optional<FitResult> explained(const Problem& given, const Attempt& first,
                                   std::span<const Hypothesis> hypotheses,
                                   const Progress& progress) {
    for (std::size_t h = 0; h < hypotheses.size(); ++h) {
        std::optional<Problem> changed = hypotheses[h].changed(given, first);
        for (int round = 0; changed && round < k_most_changes; ++round) {
            changed->options.allow_topology = false;
            FitResult again = solved(*changed, hypotheses.subspan(h + 1), progress);
            Verdict verdict = hypotheses[h].judged(given, first, *changed, std::move(again));
            if (verdict.explained) {
                say_what_changed(hypotheses[h].what, first.result, *verdict.explained);
                return std::move(verdict.explained);
            }
            changed = std::move(verdict.next);
        }
    }
    return std::nullopt;
}

FitResult with_changed_topology(const Problem& problem, FitResult result,
                                const Progress& progress) {
    FitOptions plain = problem.options;
    plain.allow_topology = false;
    const double before = result.statistics.chi2;
    FitResult fitted =
        fit_with_changes(problem.stone, problem.readings, problem.options, std::move(result),
                         [&](const Stone& changed, const std::vector<Reading>& moved) {
                             return fit_stone(changed, moved, plain, progress);
                         });
    if (!fitted.log.changes.empty()) {
        fitted.log.changed.push_back(
            {"topology", fitted.log.changes.front(), before, fitted.statistics.chi2, "chi-square"});
    }
    return fitted;
}

FitResult solved(const Problem& given, std::span<const Hypothesis> hypotheses,
                 const Progress& progress) {
    const auto [problem, restored] = prepared(given);
    Attempt first = attempt(problem, progress);
    auto better = explained(problem, first, hypotheses, progress);
    FitResult result = better ? std::move(*better) : std::move(first.result);
    if (problem.options.allow_topology) {
        result = with_changed_topology(problem, std::move(result), progress);
    }
    for (const auto& put : restored) put(result);
    return result;
}

}  // namespace

FitInput fit_input(const Stone& drawn, const std::vector<WrittenReading>& as_written) {
    const std::vector<WrittenReading> written = turned_with_mesh(drawn.file_up, as_written);
    Repaired mesh = repaired(drawn, written);
    FitInput input{std::move(mesh.stone), {}, std::move(mesh.notes)};
    input.stone.solid.design = drawn.solid.design;
    TakenOutlines outlines = take_outlines(input.stone, written);
    if (!outlines.readings.empty()) input.stone = std::move(outlines.stone);
    input.readings = bind_readings(written, input.stone, &input.notes);
    add_outlines(std::move(outlines), input.readings, input.notes);
    return input;
}

FitResult fit_stone(const FitInput& input, const FitOptions& options, const Progress& progress) {
    FitResult result = fit_stone(input.stone, input.readings, options, progress);
    result.log.notes.insert(result.log.notes.begin(), input.notes.begin(), input.notes.end());
    return result;
}

FitResult fit_stone(const Stone& stone, const std::vector<Reading>& readings,
                    const FitOptions& options, const Progress& progress) {
    const auto begin = std::chrono::steady_clock::now();
    StopScope stops(progress);
    Problem given{stone, readings, options};
    given.stone.changed.clear();  // listed once, at the end
    if (has_outlines(readings)) prepare_for_outlines(stone, given.options);
    // Like outlines, photographs move planes away from the mesh's corners.
    if (has_photographs(readings) && !options.meets_named)
        given.options = with_free_corners(stone, given.options);
    // Changes of the topology are chosen from the findings.
    given.options.findings = options.findings || options.allow_topology;
    const bool asks = options.first_check || options.prior.source != Prior::Source::none;
    given.read_in_full = !asks || readings_hold_all(stone, readings, options);
    FitResult result = solved(given, hypotheses(), stops.progress());
    if (options.find_symmetry && !result.findings.symmetry &&
        std::any_of(readings.begin(), readings.end(), declares_whole_symmetry)) {
        FitOptions from_here = options;
        from_here.start = result.solid;
        from_here.allow_topology = false;
        result.findings.symmetry = find_symmetry(stone, readings, from_here, stops.progress());
    }
    result.solid.design = stone.solid.design;
    const bool is_design = options.prior.source == Prior::Source::catalogue;
    result.findings.named_tiers =
        tier_findings(stone, readings, result.findings.suspects, is_design);
    // Report the options as asked for, but the prior and the meets as used.
    const FitOptions used = result.log.options;
    result.log.options = options;
    result.log.options.prior = used.prior;
    result.log.options.meets = used.meets;
    result.log.changed.insert(result.log.changed.begin(), stone.changed.begin(),
                              stone.changed.end());
    describe_outlines(readings, result);
    result.log.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (progress) progress(1);
    return result;
}

SymmetryReport find_symmetry(const Stone& stone, const std::vector<Reading>& readings,
                             const FitOptions& options, const Progress& progress) {
    std::vector<Reading> free = readings;
    std::erase_if(free, declares_whole_symmetry);
    FitOptions asking = options;
    asking.find_symmetry = true;
    asking.findings = true;
    return fit_stone(stone, free, asking, progress).findings.symmetry.value_or(SymmetryReport());
}

Stone fitted_stone(const Stone& drawn, const FitResult& result) {
    Stone stone = drawn;
    stone.solid = result.solid;
    stone.unit = result.unit;
    stone.up_facet.clear();
    stone.up = {0, 0, 1};
    stone.changed = result.log.changed;
    return stone;
}

void require_earlier_result(const Solid& start, const Solid& mesh,
                            const std::filesystem::path& file) {
    for (const Facet& facet : mesh.facets) {
        if (find_facet(start, facet.name) < 0) {
            throw InputError(file,
                             fmt::format("has no facet \"{}\" of the stone's mesh: --from takes "
                                         "an earlier result of the same stone",
                                         facet.name));
        }
    }
}

}  // namespace culet
