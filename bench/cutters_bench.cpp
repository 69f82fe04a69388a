// Simulated cutters: is the slip named, is the stone found, are its uncertainties honest?

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "fit/fit.h"
#include "tests/fit/cutters.h"

namespace culet::bench {

namespace {

struct Tally {
    int sets = 0, named_first = 0, alarms = 0, sound = 0, steep_named = 0, steep_asked = 0;
    int within = 0, unread = 0, within_azimuth = 0, unread_azimuth = 0;
    double read_squares = 0, error_squares = 0;  ///< in sigmas; degrees
    int read = 0;
    double seconds = 0, longest = 0;

    void operator+=(const Tally& t) {
        sets += t.sets;
        named_first += t.named_first;
        alarms += t.alarms;
        sound += t.sound;
        steep_named += t.steep_named;
        steep_asked += t.steep_asked;
        within += t.within;
        unread += t.unread;
        within_azimuth += t.within_azimuth;
        unread_azimuth += t.unread_azimuth;
        read_squares += t.read_squares;
        error_squares += t.error_squares;
        read += t.read;
        seconds += t.seconds;
        longest = std::max(longest, t.longest);
    }
};

// As in the stone file; empty: not stated.
std::string meets_asked;

FitResult fit_evening(const Evening& evening) {
    FitOptions options;
    for (const MeetTreatment how :
         {MeetTreatment::exact, MeetTreatment::soft, MeetTreatment::released}) {
        if (meets_asked != name_of(how)) continue;
        options.meets = how;
        options.meets_named = true;
    }
    options.prior.source = Prior::Source::catalogue;
    options.first_check = true;
    return fit_stone(evening.design, bind_readings(evening.rows, evening.design), options);
}

bool names_first(const FitResult& result, const std::vector<Reading>& readings,
                 const std::vector<long>& lines) {
    if (result.findings.suspects.empty()) return false;
    const auto first = std::find_if(readings.begin(), readings.end(), [&](const Reading& r) {
        return r.id == result.findings.suspects.front();
    });
    return first != readings.end() &&
           std::find(lines.begin(), lines.end(), first->line) != lines.end();
}

// The errors of the facets, in the fit's own sigmas.
void count_facets(const Evening& evening, const FitResult& result, Tally& tally) {
    for (std::size_t f = 0; f < result.facets.size(); ++f) {
        const FittedFacet& fitted = result.facets[f];
        const int there = find_facet(evening.truth, fitted.name);
        if (fitted.name == "T" || there < 0) continue;
        const Vec3& n = evening.truth.facets[std::size_t(there)].plane.normal;
        const double off =
            (fitted.inclination - inclination(n, {0, 0, 1})) / fitted.sigma_inclination;
        if (evening.was_read[f]) {
            tally.read_squares += off * off;
            tally.error_squares += std::pow(off * degrees(fitted.sigma_inclination), 2);
            ++tally.read;
        } else {
            tally.within += std::abs(off) < 1;
            ++tally.unread;
        }
        const double turned = std::remainder(fitted.azimuth - azimuth(n), 2 * std::numbers::pi);
        tally.within_azimuth += std::abs(turned) < fitted.sigma_azimuth;
        ++tally.unread_azimuth;
    }
}

void count(const Evening& evening, bool verbose, Tally& tally) {
    const FitResult result = fit_evening(evening);
    const std::vector<Reading> readings = bind_readings(evening.rows, evening.design);
    ++tally.sets;
    const bool named = names_first(result, readings, evening.wrong_lines);
    tally.named_first += named;
    const bool is_clean = evening.wrong_lines.empty();
    tally.alarms += is_clean && !result.findings.suspects.empty();
    const bool sound =
        result.checks.closed && result.checks.convex && result.checks.missing_facets.empty();
    tally.sound += sound;
    tally.seconds += result.log.seconds;
    tally.longest = std::max(tally.longest, result.log.seconds);
    if (verbose && ((is_clean ? !result.findings.suspects.empty() : !named) || !sound)) {
        fmt::print("    line {}: {} {}\n", is_clean ? 0 : evening.wrong_lines[0],
                   name_of(result.status), result.message);
    }
    if (sound && is_clean) count_facets(evening, result, tally);
    if (is_clean) {
        ++tally.steep_asked;
        tally.steep_named +=
            std::all_of(evening.steep.begin(), evening.steep.end(), [&](const std::string& name) {
                return std::any_of(
                    result.findings.named_tiers.begin(), result.findings.named_tiers.end(),
                    [&](const NamedTierFinding& tier) {
                        return std::any_of(
                            tier.odd.begin(), tier.odd.end(), [&](const OddFacets& o) {
                                return std::find(o.facets.begin(), o.facets.end(), name) !=
                                       o.facets.end();
                            });
                    });
            });
    }
}

double percent(int part, int whole) {
    return whole > 0 ? 100.0 * part / whole : 0;
}

void print(const std::string& what, const Tally& t, bool clean) {
    fmt::print("{:34} {:4} sets  sound {:5.1f} %  mean {:.2f} s, longest {:.2f} s", what, t.sets,
               percent(t.sound, t.sets), t.seconds / t.sets, t.longest);
    if (!clean) {
        fmt::print("  slip named first {:5.1f} %\n", percent(t.named_first, t.sets));
        return;
    }
    fmt::print("  false alarms {:.1f} %  two mains named {:.1f} %\n", percent(t.alarms, t.sets),
               percent(t.steep_named, t.steep_asked));
    fmt::print(
        "{:34} inclinations read: {:.3f} degrees rms, {:.2f} sigma; not read: {:.1f} % within one "
        "sigma; azimuths (none read): {:.1f} %\n",
        "", std::sqrt(t.error_squares / std::max(1, t.read)),
        std::sqrt(t.read_squares / std::max(1, t.read)), percent(t.within, t.unread),
        percent(t.within_azimuth, t.unread_azimuth));
    std::fflush(stdout);
}

}  // namespace

}  // namespace culet::bench

int main(int argc, char** argv) {
    using namespace culet::bench;
    CLI::App app("Simulated cutters: slips named, stones found, uncertainties honest");
    int sets = 50;
    std::uint64_t seed = 1;
    bool verbose = false, clean_only = false, whole_tiers = false;
    std::string only;
    Population population;
    app.add_option("--sets", sets, "of each cut, with a slip and without");
    app.add_option("--seed", seed, "of the first set");
    app.add_option("--only", only, "cuts whose name contains this");
    app.add_option("--facets", population.facet_deg, "facets off their tier, degrees");
    app.add_option("--tiers", population.tier_deg, "tiers off the design, degrees");
    app.add_option("--two", population.two_deg, "two mains off, degrees");
    app.add_option("--meets", population.meets, "the stone's meets are exact");
    app.add_option("--treat", meets_asked, "meets as the stone file has them; else by evidence")
        ->check(CLI::IsMember({"exact", "soft", "released"}));
    app.add_flag("--verbose", verbose, "what was said of sets that went wrong");
    app.add_flag("--clean", clean_only, "no slips");
    app.add_flag("--whole-tiers", whole_tiers, "the slip is a tier typed with another's values");
    CLI11_PARSE(app, argc, argv);
    Tally all, all_clean;
    for (const char* cut : {"round-brilliant", "oval", "cushion", "step", "pear", "trillion"}) {
        if (std::string(cut).find(only) == std::string::npos) continue;
        Tally clean, slips;
        for (int i = 0; i < sets; ++i) {
            count(cutters_evening(cut, population, Slipped::none, seed + std::uint64_t(i)), verbose,
                  clean);
            if (clean_only) continue;
            const auto slip = whole_tiers ? Slipped::whole_tier : Slipped(1 + i % k_slips);
            count(cutters_evening(cut, population, slip, seed + std::uint64_t(i)), verbose, slips);
        }
        all_clean += clean;
        all += slips;
        print(std::string(cut) + ", clean", clean, true);
        if (!clean_only) print(std::string(cut) + ", one slip", slips, false);
    }
    print("all, clean", all_clean, true);
    if (!clean_only) print("all, one slip", all, false);
    return 0;
}
