// Compares two states of the fit, fit by fit: which stones were found, which were lost, and the
// cost.
//
//   bench_corpus --json after.json --against docs/benchmarks/fit-corpus.json
//   bench_corpus --read after.json --against before.json        (compares only)

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/fit_corpus.h"
#include "stone/numbers/upper_median.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet::bench {
namespace {

using Json = nlohmann::ordered_json;

// `found`: valid, and the optimum of the fit from the truth or better (fit_trials.h). `broken`:
// called good, but not a whole stone.
Json report_of(const CorpusFit& one) {
    const Trial trial = one.fit();
    const bool valid = trial.refusal.empty() && is_valid(one.declared, trial.result);
    Json report{{"name", one.name},
                {"group", one.group},
                {"found", succeeds(one.declared, trial, one.reference())},
                {"valid", valid},
                {"broken", !valid && trial.refusal.empty() && trial.result.usable()},
                {"status", trial.refusal.empty() ? name_of(trial.result.status) : trial.refusal}};
    // To a thousandth, so that rounding errors in the last digits do not count as changes.
    report["chi2"] =
        trial.refusal.empty() ? Json(std::round(1e3 * trial.result.statistics.chi2) / 1e3) : Json();
    report["reference_chi2"] = std::round(1e3 * one.reference().result.statistics.chi2) / 1e3;
    report["ms"] = std::round(1e4 * trial.cpu) / 10;
    return report;
}

struct Group {
    int fits = 0, found = 0, broken = 0, found_before = 0;
    std::vector<double> ms, ms_before;
};

// Prints each group's results before and after, and the lost and gained fits. Returns the number of
// lost ones.
int compare(const Json& now, const Json& before) {
    std::map<std::string, Json> old;
    for (const Json& one : before.at("fits")) old[one.at("name")] = one;
    std::vector<std::string> order;
    std::map<std::string, Group> groups;
    std::vector<std::string> lost, gained;
    double total = 0, total_before = 0;
    for (const Json& one : now.at("fits")) {
        const std::string name = one.at("group");
        if (!groups.contains(name)) order.push_back(name);
        Group& group = groups[name];
        ++group.fits;
        const bool found = one.at("found"), broken = one.at("broken");
        group.found += found;
        group.broken += broken;
        group.ms.push_back(one.at("ms"));
        total += group.ms.back();
        const auto was = old.find(one.at("name"));
        if (was == old.end()) continue;
        group.found_before += was->second.at("found").get<bool>();
        group.ms_before.push_back(was->second.at("ms"));
        total_before += group.ms_before.back();
        const std::string words = fmt::format(
            "{}: chi-square {}, before {}, from the truth {}", one.at("name").get<std::string>(),
            one.at("chi2").dump(), was->second.at("chi2").dump(), one.at("reference_chi2").dump());
        if (was->second.at("found") && !found) lost.push_back(words);
        if (!was->second.at("found") && found) gained.push_back(words);
    }
    fmt::print("{:<36} {:>9} {:>9} {:>7} {:>9} {:>9}\n", "", "found", "before", "broken", "ms",
               "before");
    for (const std::string& name : order) {
        const Group& g = groups[name];
        const bool known = !g.ms_before.empty();
        fmt::print("{:<36} {:>9} {:>9} {:>7} {:>9.1f} {:>9}\n", name,
                   fmt::format("{}/{}", g.found, g.fits),
                   known ? fmt::format("{}", g.found_before) : "", g.broken, upper_median(g.ms),
                   known ? fmt::format("{:.1f}", upper_median(g.ms_before)) : "");
    }
    fmt::print("CPU in all: {:.1f} s", total / 1e3);
    if (total_before > 0) {
        fmt::print(", before {:.1f} s; lost {}, gained {}", total_before / 1e3, lost.size(),
                   gained.size());
    }
    fmt::print("\n");
    for (const std::string& words : lost) fmt::print("lost    {}\n", words);
    for (const std::string& words : gained) fmt::print("gained  {}\n", words);
    return static_cast<int>(lost.size());
}

Json read_json(const std::string& file) {
    std::ifstream in(file);
    if (!in) throw InputError(file, "cannot be read");
    return Json::parse(in);
}

}  // namespace
}  // namespace culet::bench

int main(int argc, char** argv) {
    using namespace culet;
    using namespace culet::bench;
    CLI::App app{"The corpus of fits: which are found, which are lost against another state."};
    unsigned seeds = 20, draws = 5;
    std::string json, against, read, only;
    std::vector<std::string> scans;
    app.add_option("--seeds", seeds, "stones of each kind")->check(CLI::Range(1, 1000));
    app.add_option("--only", only, "fits whose name contains this");
    app.add_option("--scan", scans, "also a scanned stone: a file of vertices and facets");
    app.add_option("--draws", draws, "sets of readings of a scanned stone");
    app.add_option("--json", json, "write what was found here");
    app.add_option("--against", against, "an earlier file to compare with");
    app.add_option("--read", read, "compare this file, and fit nothing");
    try {
        app.parse(argc, argv);
        Json now{{"schema", "1"}, {"fits", Json::array()}};
        if (!read.empty()) {
            now = read_json(read);
        } else {
            std::vector<CorpusFit> corpus = synthetic_corpus(seeds);
            for (const std::string& scan : scans) {
                for (CorpusFit& one : scanned_corpus(scan, draws)) corpus.push_back(std::move(one));
            }
            for (const CorpusFit& one : corpus) {
                if (one.name.find(only) == std::string::npos) continue;
                now["fits"].push_back(report_of(one));
            }
        }
        // One line per fit, so that people can compare two states.
        std::string text = "{\"schema\": \"1\", \"fits\": [\n";
        for (std::size_t i = 0; i < now["fits"].size(); ++i) {
            text += now["fits"][i].dump() + (i + 1 < now["fits"].size() ? ",\n" : "\n");
        }
        if (!json.empty()) write_text(json, text + "]}\n");
        const Json before = against.empty() ? Json{{"fits", Json::array()}} : read_json(against);
        return compare(now, before) > 0 ? 1 : 0;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "bench_corpus: " << error.what() << "\n";
    } catch (const std::exception& error) {
        std::cerr << "bench_corpus: " << error.what() << "\n";
    }
    return 2;
}
