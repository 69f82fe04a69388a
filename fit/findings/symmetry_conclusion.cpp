#include "fit/findings/symmetry_conclusion.h"

#include <fmt/format.h>

#include <algorithm>

#include "stone/numbers/units.h"

namespace culet {

namespace {

std::string in_degrees(double angle) {
    return fmt::format("{:.2g}", degrees(angle));
}

// What a group says in a stone file.
std::vector<std::string> readings_for(const GroupTest& test, const std::string& how) {
    std::vector<std::string> readings;
    if (test.order > 1) {
        readings.push_back(fmt::format("kind = \"rotation\", of = [\"{}\"], {}", test.order, how));
    }
    if (test.mirrors) {
        readings.push_back(fmt::format("kind = \"mirror\", of = [\"{:.6g}\"], {}",
                                       degrees(test.mirror_azimuth), how));
    }
    return readings;
}

}  // namespace

void conclude(SymmetryReport& report, double level) {
    const GroupTest* proposed = nullptr;
    for (const GroupTest& test : report.groups) {
        if (test.supported && test.determined && !proposed) proposed = &test;
    }
    const GroupTest& form = report.groups.front();
    const std::string spread =
        fmt::format("facets within {} degrees of it (sigma {})", in_degrees(report.sigma),
                    in_degrees(report.sigma_sigma));
    if (proposed) {
        report.proposed = proposed->group;
        report.readings = readings_for(*proposed, "exact = true");
        report.message = fmt::format(
            "{} is supported: chi2 {:.1f} for {} of {} conditions, p {:.2g}", proposed->group,
            proposed->chi2, proposed->tested, proposed->conditions, proposed->p);
        if (proposed != &form) {
            report.message +=
                fmt::format("; {} is denied (p {:.2g}), {}", form.group, form.p, spread);
        }
        return;
    }
    // A single level facet may be all that is askew: the table that everything else is read from.
    std::string askew;
    bool others = false;
    for (const TierSymmetry& tier : report.tiers) {
        if (tier.p >= level) continue;
        others = others || tier.facets.size() > 1 || !askew.empty();
        askew =
            fmt::format("{}, which stands {} degrees off", tier.tier, in_degrees(tier.worst_off));
    }
    if (!form.determined) {
        report.message =
            fmt::format("the readings leave {} open: they tell of {} of its {} conditions only",
                        form.group, form.tested, form.conditions);
        return;
    }
    report.message =
        fmt::format("no exact symmetry: {} is denied (chi2 {:.1f} for {}, p {:.2g}); {}",
                    form.group, form.chi2, form.tested, form.p, spread);
    if (!askew.empty() && !others) {
        report.message += fmt::format("; the stone would have it but for {}", askew);
    }
    report.readings =
        readings_for(form, fmt::format("sigma = {:.2g}", std::max(1e-6, degrees(report.sigma))));
}

}  // namespace culet
