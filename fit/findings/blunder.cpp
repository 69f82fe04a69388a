#include "fit/findings/blunder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/readings/slips.h"
#include "stone/errors.h"
#include "stone/units.h"

namespace culet {

namespace {

// Reading and estimate are trusted for so many of their sigmas.
constexpr double k_trust = 3.5;

}  // namespace

double slip_tolerance(const Reading& reading, double sigma_of_estimate) {
    return k_trust * std::hypot(sigma_of_estimate, reading.sigma);
}

void explain_by_slip(const Reading& reading, Proposal& proposal) {
    // Slips are made in the unit of files.
    const double unit = is_angle(reading.kind) ? degrees(1) : 1;
    const double within = unit * slip_tolerance(reading, proposal.sigma);
    if (const auto slip =
            find_slip(unit * reading.value, {unit * proposal.estimate, within / k_trust, within},
                      measured_by(reading.kind))) {
        proposal.slip = slip->what;
        proposal.corrected = slip->corrected / unit;
    }
}

void flag_blunders(const std::vector<Reading>& readings, const std::vector<Blunder>& blunders,
                   FitResult& result) {
    std::vector<Proposal> proposals;
    std::vector<std::string> ids;
    std::string text;
    for (const Blunder& g : blunders) {
        const Reading& r = readings[g.reading];
        const double unit = is_angle(r.kind) ? degrees(1) : 1;
        const auto fitted =
            std::find_if(result.readings.begin(), result.readings.end(),
                         [&](const FittedReading& other) { return other.id == r.id; });
        check(fitted != result.readings.end(), "an accused reading is not listed");
        fitted->value = r.value;
        fitted->sigma = r.sigma;
        fitted->fitted = g.estimate;
        fitted->residual = r.kind == ReadingKind::azimuth
                               ? std::remainder(g.estimate - r.value, 2 * std::numbers::pi)
                               : g.estimate - r.value;
        fitted->normalized = fitted->residual / std::hypot(g.sigma, r.sigma);
        fitted->redundancy = 1;
        fitted->suspect = true;
        fitted->left_out = "no stone could be found with it";
        Proposal proposal;
        proposal.id = r.id;
        proposal.in_radians = is_angle(r.kind);
        proposal.estimate = g.estimate;
        proposal.sigma = g.sigma;
        explain_by_slip(r, proposal);
        std::string of;
        for (const std::string& name : r.of) of += (of.empty() ? " of " : "/") + name;
        if (of.empty() && !r.facets.empty()) {
            of = " of " + result.facets[std::size_t(r.facets[0])].name;
        }
        text +=
            fmt::format("{}{} ({}{}: read {:g}, the others say {:.4g}{})", text.empty() ? "" : ", ",
                        r.id, name_of(r.kind), of, unit * r.value, unit * g.estimate,
                        proposal.slip.empty()
                            ? ""
                            : fmt::format("; {}: {:g}?", proposal.slip, unit * proposal.corrected));
        proposals.push_back(std::move(proposal));
        ids.push_back(r.id);
    }
    result.findings.suspects.insert(result.findings.suspects.begin(), ids.begin(), ids.end());
    result.findings.proposals.insert(result.findings.proposals.begin(), proposals.begin(),
                                     proposals.end());
    const std::string left_out =
        fmt::format("reading{} {} cannot belong to the others and {} left out",
                    blunders.size() == 1 ? "" : "s", text, blunders.size() == 1 ? "is" : "are");
    result.message = result.status == FitStatus::converged
                         ? left_out
                         : left_out + "; without: " + result.message;
    if (result.status != FitStatus::not_converged) result.status = FitStatus::contradictory;
    result.log.notes.push_back(left_out);
}

}  // namespace culet
