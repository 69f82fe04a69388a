#include "fit/findings/blunder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/findings/fitted_parts.h"
#include "fit/findings/words.h"
#include "fit/readings/slips.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Reading and estimate are trusted for so many of their sigmas.
constexpr double k_trust = 3.5;

}  // namespace

Proposal proposal_for(const Reading& reading, double estimate, double sigma, double part_missed) {
    Proposal proposal{reading.id, is_angle(reading.kind), estimate, sigma, {}, 0, {}};
    // Slips are made in the unit of files.
    const double unit = file_unit(reading.kind);
    const double both = std::hypot(sigma, reading.sigma), within = k_trust * both;
    if (is_relation(reading.kind) || !(within < part_missed * std::abs(reading.value - estimate))) {
        return proposal;
    }
    if (const auto slip =
            find_slip(unit * reading.value, {unit * estimate, unit * both, unit * within},
                      measured_by(reading.kind))) {
        proposal.slip = slip->what;
        proposal.corrected = slip->corrected / unit;
    }
    return proposal;
}

FittedReading left_out(const Reading& reading, const Proposal& proposal, const char* why) {
    FittedReading fitted = as_taken(reading);
    const double off = proposal.estimate - reading.value;
    fitted.fitted = proposal.estimate;
    fitted.residual =
        reading.kind == ReadingKind::azimuth ? std::remainder(off, 2 * std::numbers::pi) : off;
    fitted.normalized = fitted.residual / std::hypot(proposal.sigma, reading.sigma);
    fitted.redundancy = 1;
    fitted.suspect = true;
    fitted.left_out = why;
    return fitted;
}

void accuse(const std::vector<Proposal>& proposals, const std::string& told, FitResult& result) {
    FitFindings& findings = result.findings;
    findings.proposals.insert(findings.proposals.begin(), proposals.begin(), proposals.end());
    std::vector<std::string> ids;
    for (const Proposal& p : proposals) ids.push_back(p.id);
    findings.suspects.insert(findings.suspects.begin(), ids.begin(), ids.end());
    const bool was_good = result.status == FitStatus::converged;
    result.message = was_good ? told : told + "; without: " + result.message;
    if (result.status != FitStatus::not_converged) result.status = FitStatus::contradictory;
}

void flag_blunders(const std::vector<Reading>& readings, const std::vector<Blunder>& blunders,
                   FitResult& result) {
    std::vector<Proposal> proposals;
    std::vector<std::string> words;
    for (const Blunder& blunder : blunders) {
        const Reading& r = readings[blunder.reading];
        const auto listed =
            std::find_if(result.readings.begin(), result.readings.end(),
                         [&](const FittedReading& other) { return other.id == r.id; });
        check(listed != result.readings.end(), "an accused reading is not listed");
        proposals.push_back(proposal_for(r, blunder.estimate, blunder.sigma));
        *listed = left_out(r, proposals.back(), "no stone could be found with it");
        const double unit = file_unit(r.kind);
        words.push_back(fmt::format("{} ({}{}: read {:g}, the others say {:.4g}{})", r.id,
                                    name_of(r.kind), of_words(r.of), unit * r.value,
                                    unit * blunder.estimate, slip_words(proposals.back())));
    }
    const bool one = blunders.size() == 1;
    const std::string told = fmt::format("reading{} {} cannot belong to the others and {} left out",
                                         one ? "" : "s", name_list(words), one ? "is" : "are");
    accuse(proposals, told, result);
    result.log.notes.push_back(told);
}

}  // namespace culet
