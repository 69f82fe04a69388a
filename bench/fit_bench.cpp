// Measures the fit: how often it finds the stone by the error of the start mesh, whether it ever
// calls a broken stone good, and its time. Random stones from seeds; docs/accuracy.md has the
// figures, docs/fit-times.md the times.
//
//   bench_fit [--seeds N] [--section NAME] [--stone NAME] [--at PERCENT] [--json FILE]

#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "bench/bench_table.h"
#include "stone/numbers/upper_median.h"
#include "stone/text/output_file.h"
#include "tests/fit/fit_trials.h"

namespace culet::bench {
namespace {

struct Class {
    TruthKind kind;
    bool symmetric;
    std::string name() const {
        return fmt::format("{}, {}", name_of(kind), symmetric ? "symmetric" : "none");
    }
};
const std::vector<Class> k_classes{{TruthKind::round, true}, {TruthKind::round, false},
                                   {TruthKind::step, true},  {TruthKind::step, false},
                                   {TruthKind::pear, false}, {TruthKind::trillion, false}};

struct Chosen {
    unsigned first_seed = 1, seeds = 20;
    std::string stone;       // empty: all
    std::vector<double> at;  // percent; empty: all
    bool verbose = false;

    bool takes(const std::string& name) const { return stone.empty() || stone == name; }
    std::vector<double> parts(const std::vector<double>& usual) const {
        if (at.empty()) return usual;
        std::vector<double> result;
        for (double percent : at) result.push_back(percent / 100);
        return result;
    }
};

template <typename Mesh>
void success_table(BenchTables& tables, const std::string& name, const std::string& remark,
                   const std::vector<double>& parts, const Chosen& chosen, Mesh mesh) {
    std::vector<std::string> columns;
    for (double p : parts) columns.push_back(fmt::format("{:g} %", 100 * p));
    for (double p : parts) columns.push_back(fmt::format("ms at {:g} %", 100 * p));
    tables.section(name, remark, columns);
    for (const Class& c : k_classes) {
        if (!chosen.takes(c.name())) continue;
        std::vector<int> good(parts.size(), 0);
        std::vector<std::vector<double>> times(parts.size());
        const unsigned end = chosen.first_seed + chosen.seeds;
        for (unsigned seed = chosen.first_seed; seed < end; ++seed) {
            const Truth truth = make_truth(c.kind, c.symmetric, seed);
            const auto readings = read_by_instruments(truth, 1000 + seed);
            const Trial reference = fit_mesh(truth.stone, readings);
            for (std::size_t p = 0; p < parts.size(); ++p) {
                const Trial trial = fit_mesh(mesh(truth.stone, parts[p], 77 * seed + 5), readings);
                const bool ok = succeeds(truth.stone, trial, reference);
                good[p] += ok;
                times[p].push_back(1e3 * trial.cpu);
                if (!ok && chosen.verbose) {
                    std::cerr << fmt::format(
                        "{} seed {} at {}: {} chi2 {:.1f} (reference {:.1f} dof {:.0f}) {} {} {}\n",
                        c.name(), seed, parts[p], is_valid(truth.stone, trial.result),
                        trial.result.statistics.chi2, reference.result.statistics.chi2,
                        reference.result.statistics.dof, trial.result.message, trial.refusal,
                        reference.result.message);
                }
            }
        }
        std::vector<std::string> values;
        for (int g : good) values.push_back(fmt::format("{}/{}", g, chosen.seeds));
        for (const auto& t : times) values.push_back(fmt::format("{:.1f}", upper_median(t)));
        tables.line(c.name(), values);
    }
}

void kick_table(BenchTables& tables, unsigned kicks, bool verbose) {
    tables.section("kick",
                   "one corner moved by the distance to its nearest neighbour; broken: called good "
                   "but not closed, convex and whole",
                   {"facets", "same optimum", "valid", "broken", "ms"});
    struct Stones {
        std::string name;
        std::vector<Truth> truths;
    };
    std::vector<Stones> all;
    const auto add = [&](std::string name, auto make) {
        Stones s{std::move(name), {}};
        for (unsigned seed = 1; seed <= 2; ++seed) s.truths.push_back(make(seed));
        all.push_back(std::move(s));
    };
    add("tiered 26", [](unsigned s) { return make_tiered(26, s); });
    add("step", [](unsigned s) { return make_truth(TruthKind::step, false, s); });
    add("round", [](unsigned s) { return make_truth(TruthKind::round, false, s); });
    add("round, symmetric", [](unsigned s) { return make_truth(TruthKind::round, true, s); });
    add("tiered 120", [](unsigned s) { return make_tiered(120, s); });
    add("tiered 300", [](unsigned s) { return make_tiered(300, s); });
    for (const Stones& stones : all) {
        int good = 0, valid = 0, broken = 0;
        unsigned count = 0;
        std::vector<double> times;
        for (const Truth& truth : stones.truths) {
            const auto readings = read_by_instruments(truth, 99);
            const Trial reference = fit_mesh(truth.stone, readings);
            for (unsigned k = 0; k < kicks / 12 + 1; ++k) {
                const Trial trial = fit_mesh(kicked_mesh(truth.stone, 31 * k + 7), readings);
                ++count;
                const bool whole = is_valid(truth.stone, trial.result);
                valid += whole;
                broken += !whole && trial.result.usable();
                good += succeeds(truth.stone, trial, reference);
                times.push_back(1e3 * trial.cpu);
                if (verbose && !succeeds(truth.stone, trial, reference)) {
                    std::cerr << fmt::format("{} kick {}: {} {} | {}\n", stones.name, k,
                                             trial.result.message, trial.refusal,
                                             reference.result.message);
                }
            }
        }
        tables.line(stones.name,
                    {fmt::format("{}", stones.truths[0].stone.solid.facets.size()),
                     fmt::format("{}/{}", good, count), fmt::format("{}/{}", valid, count),
                     fmt::format("{}", broken), fmt::format("{:.1f}", upper_median(times))});
    }
}

// Findings: the stone's own axis, meets, edges and facets that contradict the readings, extra
// facets.
FitOptions without_findings() {
    FitOptions options;
    options.findings = false;
    return options;
}

void time_table(BenchTables& tables, const Chosen& chosen, unsigned large) {
    tables.section("times", "median CPU of all threads, with covariance; mesh: corner noise",
                   {"facets", "readings", "mesh", "ms", "figure", "with findings", "status"});
    const auto line = [&](const std::string& name, auto make, double noise, unsigned count,
                          double figure, int edges = -1) {
        if (!chosen.takes(name)) return;
        std::vector<double> times, times_with_findings;
        std::size_t facets = 0, readings_count = 0;
        std::string status;
        for (unsigned seed = 1; seed <= count; ++seed) {
            const Truth truth = make(seed);
            const auto readings = read_by_instruments(truth, 1000 + seed, edges);
            const Stone mesh = noise > 0 ? noisy_mesh(truth.stone, noise, seed) : truth.stone;
            times.push_back(1e3 * fit_mesh(mesh, readings, without_findings()).cpu);
            const Trial trial = fit_mesh(mesh, readings);
            times_with_findings.push_back(1e3 * trial.cpu);
            facets = truth.stone.solid.facets.size();
            readings_count = trial.result.readings.size();
            status = trial.refusal.empty() ? name_of(trial.result.status) : trial.refusal;
            if (chosen.verbose) {
                std::cerr << fmt::format("{} {} seed {}: {:.1f} ms, {}, chi-square {:.1f}\n", name,
                                         facets, seed, times.back(), status,
                                         trial.result.statistics.chi2);
            }
        }
        tables.line(name, {fmt::format("{}", facets), fmt::format("{}", readings_count),
                           fmt::format("{:g} %", 100 * noise),
                           fmt::format("{:.1f}", upper_median(times)), fmt::format("{:g}", figure),
                           fmt::format("{:.1f}", upper_median(times_with_findings)), status});
    };
    for (const Class& c : k_classes) {
        const auto make = [&](unsigned seed) { return make_truth(c.kind, c.symmetric, seed); };
        line(c.name(), make, 0.01, chosen.seeds, c.symmetric ? 10 : 60);
        line(c.name(), make, 0.2, chosen.seeds, 1000);
    }
    line(
        "tiered", [](unsigned s) { return make_tiered(300, s); }, 0.003, std::min(chosen.seeds, 5u),
        2000);
    if (large > 0) {
        line(
            "tiered", [](unsigned s) { return make_tiered(600, s); }, 0.001, large, 20000);
        line(
            "tiered", [](unsigned s) { return make_tiered(1000, s); }, 0.001, large, 20000, 2000);
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    tables.remark(fmt::format("most memory: {:.0f} MB", double(usage.ru_maxrss) / 1024));
}

// Starts from an earlier result after one reading was taken again (another draw of its error).
void refit_table(BenchTables& tables, const Chosen& chosen) {
    tables.section("refit",
                   "from the last result after one edited reading, with covariance; figure: 10 ms",
                   {"readings", "ms, least", "ms", "ms, most", "with findings", "as fresh"});
    for (const Class& c : k_classes) {
        if (!chosen.takes(c.name())) continue;
        std::vector<double> times, times_with_findings;
        std::size_t count = 0;
        unsigned same = 0;
        for (unsigned seed = 1; seed <= chosen.seeds; ++seed) {
            const Truth truth = make_truth(c.kind, c.symmetric, seed);
            auto readings = read_by_instruments(truth, 1000 + seed);
            FitOptions options;
            options.start = fit_mesh(truth.stone, readings).result.solid;
            const auto again = read_by_instruments(truth, 5000 + seed);
            std::size_t edited = (7 * seed) % readings.size();
            while (!readings[edited].value) edited = (edited + 1) % readings.size();
            readings[edited].value = again[edited].value;
            times_with_findings.push_back(1e3 * fit_mesh(truth.stone, readings, options).cpu);
            options.findings = false;
            const Trial trial = fit_mesh(truth.stone, readings, options);
            const Trial fresh = fit_mesh(truth.stone, readings, without_findings());
            times.push_back(1e3 * trial.cpu);
            count = readings.size();
            same += trial.result.log.start == "earlier result" &&
                    trial.result.statistics.chi2 < fresh.result.statistics.chi2 + 0.1;
        }
        tables.line(c.name(), {fmt::format("{}", count),
                               fmt::format("{:.1f}", *std::min_element(times.begin(), times.end())),
                               fmt::format("{:.1f}", upper_median(times)),
                               fmt::format("{:.1f}", *std::max_element(times.begin(), times.end())),
                               fmt::format("{:.1f}", upper_median(times_with_findings)),
                               fmt::format("{}/{}", same, chosen.seeds)});
    }
}

}  // namespace
}  // namespace culet::bench

int main(int argc, char** argv) {
    using namespace culet;
    using namespace culet::bench;
    CLI::App app{"Success, safety and time of the fit, in tables on stdout."};
    Chosen chosen;
    unsigned kicks = 1000;
    std::string section, json;
    unsigned large = 0;
    app.add_option("--seeds", chosen.seeds, "stones of each kind")->check(CLI::Range(1, 100000));
    app.add_option("--first-seed", chosen.first_seed, "of noise and drawn");
    app.add_option("--stone", chosen.stone, "this one only, as the tables name it");
    app.add_option("--at", chosen.at, "noise and drawn: these errors only, in percent");
    app.add_option("--kicks", kicks, "in all")->check(CLI::Range(1, 1000000));
    app.add_option("--section", section, "run this part only: noise, drawn, kick, refit, times");
    app.add_option("--json", json, "also write the tables here");
    app.add_flag("--verbose", chosen.verbose,
                 "name each failure, and the time of each stone, on stderr");
    app.add_flag("--large{1}", large,
                 "also time stones of 600 and of 1000 facets, or several: --large=4");
    try {
        app.parse(argc, argv);
        BenchTables tables;
        const auto wanted = [&](const std::string& name) {
            return section.empty() || section == name;
        };
        if (wanted("noise")) {
            success_table(tables, "noise",
                          "found from corner noise (root mean square, of the diameter): same "
                          "optimum as from the truth, whole, convex, planar",
                          chosen.parts({0.01, 0.03, 0.05, 0.1, 0.2, 0.4}), chosen, noisy_mesh);
        }
        if (wanted("drawn")) {
            success_table(tables, "drawn",
                          "found from a modeller's errors: axes, radii of tiers and depths wrong",
                          chosen.parts({0.05, 0.1, 0.2, 0.3}), chosen, wrongly_drawn);
        }
        if (wanted("kick")) kick_table(tables, kicks, chosen.verbose);
        if (wanted("refit")) refit_table(tables, chosen);
        if (wanted("times")) time_table(tables, chosen, large);
        if (!json.empty()) write_text(json, tables.json({{"schema", "1"}}));
        return 0;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "bench_fit: " << error.what() << "\n";
    } catch (const std::exception& error) {
        std::cerr << "bench_fit: " << error.what() << "\n";
    }
    return 2;
}
