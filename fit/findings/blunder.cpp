#include "fit/findings/blunder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/findings/words.h"
#include "fit/readings/slips.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Reading and estimate are trusted to within this many of their sigmas.
constexpr double k_trust = 3.5;

}  // namespace

Proposal proposal_for(const Reading& reading, double estimate, double sigma, double part_missed) {
    Proposal proposal{reading.id, is_angle(reading.kind), estimate, sigma, {}, 0, {}};
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

void mark_left_out(const std::vector<Reading>& readings, const std::vector<std::size_t>& left_out,
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

void flag_blunder(const Reading& wrong, double estimate, double sigma, FitResult& result) {
    const auto listed = std::find_if(result.readings.begin(), result.readings.end(),
                                     [&](const FittedReading& r) { return r.id == wrong.id; });
    check(listed != result.readings.end(), "an accused reading is not listed");
    const Proposal proposal = proposal_for(wrong, estimate, sigma);
    *listed = left_out(wrong, proposal, "no stone could be found with it");
    const double unit = file_unit(wrong.kind);
    const std::string told = fmt::format(
        "reading {} ({}{}: read {:g}, the others say {:.4g}{}) disagrees with the others and is "
        "left out",
        wrong.id, name_of(wrong.kind), of_words(wrong.of), unit * wrong.value, unit * estimate,
        slip_words(proposal));
    accuse({proposal}, told, result);
    result.log.notes.push_back(told);
}

}  // namespace culet
