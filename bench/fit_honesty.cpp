// Are a fit's uncertainties right, and does it find wrong readings? Known stones are measured with
// simulated noise again and again. Each figure stands beside its target.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <random>

#include "fit/fit.h"
#include "tests/cpu_time.h"
#include "tests/fit/fit_truth.h"

namespace culet::bench {

namespace {

constexpr unsigned k_first_stone = 7;

struct Coverage {
    int count = 0, within_one = 0, within_two = 0;
    double squares = 0, limit_squares = 0, chi2 = 0, dof = 0;

    void add(double error, double sigma, double limit) {
        // Symmetry leaves some angles no freedom.
        if (!(limit > 1e-9)) return;
        ++count;
        within_one += std::abs(error) < sigma;
        within_two += std::abs(error) < 2 * sigma;
        squares += error * error;
        limit_squares += limit * limit;
    }
    void add(const Coverage& other) {
        count += other.count;
        within_one += other.within_one;
        within_two += other.within_two;
        squares += other.squares;
        limit_squares += other.limit_squares;
    }
    double part_one() const { return 100.0 * within_one / count; }
    double part_two() const { return 100.0 * within_two / count; }
    double over_limit() const { return std::sqrt(squares / limit_squares); }
};

double folded(double angle) {
    return std::remainder(angle, 2 * std::numbers::pi);
}

std::vector<Reading> bound(const Truth& truth, const std::vector<WrittenReading>& written) {
    return bind_readings(written, truth.stone);
}

FitResult fit(const Truth& truth, const std::vector<WrittenReading>& written) {
    return fit_stone(truth.stone, bound(truth, written));
}

struct Sample {
    std::string name;
    TruthKind kind;
    bool symmetric;
};

void report_coverage(const Sample& which, int stones, int repetitions) {
    Coverage tilt, turn, proportion;
    int alarms = 0, unsound = 0;
    std::size_t readings = 0;
    std::vector<double> cpu;
    unsigned seed = 1000;
    for (int stone = 0; stone < stones; ++stone) {
        const Truth truth =
            make_truth(which.kind, which.symmetric, k_first_stone + unsigned(stone));
        const FitResult limit = fit(truth, read_perfectly(truth));
        readings = limit.readings.size();
        for (int i = 0; i < repetitions; ++i) {
            const std::vector<WrittenReading> written = read_by_instruments(truth, seed++);
            const Clocks before = clocks();
            const FitResult result = fit(truth, written);
            cpu.push_back(clocks().cpu - before.cpu);
            unsound += !result.checks.closed || !result.checks.convex;
            alarms +=
                !result.findings.suspects.empty() || result.status == FitStatus::contradictory;
            tilt.chi2 += result.statistics.chi2;
            tilt.dof += result.statistics.dof;
            for (std::size_t f = 0; f < result.facets.size(); ++f) {
                const FittedFacet &mine = result.facets[f], &best = limit.facets[f];
                if (mine.name == truth.stone.up_facet) continue;
                // At 90 degrees (girdle facets) an inclination has a sign ambiguity.
                const Vec3& n = truth.stone.solid.facets[f].plane.normal;
                if (std::abs(n.z) > std::sin(radians(1))) {
                    tilt.add(mine.inclination - inclination(n, {0, 0, 1}), mine.sigma_inclination,
                             best.sigma_inclination);
                }
                turn.add(folded(mine.azimuth - azimuth(n)), mine.sigma_azimuth, best.sigma_azimuth);
            }
            for (std::size_t p = 0; p < result.findings.proportions.size(); ++p) {
                if (p >= limit.findings.proportions.size()) break;
                proportion.add(
                    result.findings.proportions[p].value - limit.findings.proportions[p].value,
                    result.findings.proportions[p].sigma, limit.findings.proportions[p].sigma);
            }
        }
    }
    std::nth_element(cpu.begin(), cpu.begin() + std::ptrdiff_t(cpu.size() / 2), cpu.end());
    const auto line = [&](const char* what, const Coverage& c) {
        fmt::print("{:16} {:12} {:7.1f} {:7.1f} {:9.3f}\n", which.name, what, c.part_one(),
                   c.part_two(), c.over_limit());
    };
    line("inclination", tilt);
    line("azimuth", turn);
    Coverage angles = tilt;
    angles.add(turn);
    line("both angles", angles);
    line("proportions", proportion);
    fmt::print(
        "{:16} {} readings, chi2/dof {:.3f}, false alarms {:.1f} %, unsound {}, "
        "{:.1f} ms CPU\n",
        which.name, readings, tilt.chi2 / tilt.dof, 100.0 * alarms / double(cpu.size()), unsound,
        1e3 * cpu[cpu.size() / 2]);
    std::fflush(stdout);
}

struct Planted {
    int tried = 0, named_first = 0, named = 0, alternative = 0, seen = 0;
};

void report_detection(const Sample& which, int repetitions, double size) {
    const Truth truth = make_truth(which.kind, which.symmetric, k_first_stone);
    const FitResult limit = fit(truth, read_perfectly(truth));
    std::mt19937_64 random(42);
    std::vector<WrittenReading> sample = read_by_instruments(truth, 1);
    // Readings in which the tests can detect a slip of that size.
    std::vector<std::size_t> checked;
    std::size_t valued = 0;
    for (std::size_t r = 0; r < limit.readings.size(); ++r) {
        if (is_relation(limit.readings[r].kind)) continue;
        ++valued;
        const double detectable = limit.readings[r].detectable;
        if (detectable > 0 && detectable <= size * limit.readings[r].sigma) checked.push_back(r);
    }
    const auto plant = [&](std::vector<WrittenReading>& written, std::size_t r) {
        // Readings of a pattern get other ids, so these are written one by one.
        double sign = std::bernoulli_distribution(0.5)(random) ? 1 : -1;
        double value = *written[r].value + sign * size * *written[r].sigma;
        if (written[r].kind == "inclination" && (value > 90 || value < 0)) {
            value = *written[r].value - sign * size * *written[r].sigma;
        }
        written[r].value = value;
    };
    Planted one, two;
    for (int i = 0; i < repetitions && !checked.empty(); ++i) {
        std::vector<WrittenReading> written = read_by_instruments(truth, 5000u + unsigned(i));
        const std::size_t a =
            checked[std::uniform_int_distribution<std::size_t>(0, checked.size() - 1)(random)];
        plant(written, a);
        const FitResult result = fit(truth, written);
        const auto names = [&](const FitResult& r, std::size_t which_one) {
            return std::find(r.findings.suspects.begin(), r.findings.suspects.end(),
                             r.readings[which_one].id) != r.findings.suspects.end();
        };
        ++one.tried;
        one.seen += result.status == FitStatus::contradictory;
        one.named += names(result, a);
        one.named_first += !result.findings.suspects.empty() &&
                           result.findings.suspects[0] == result.readings[a].id;
        for (const Proposal& p : result.findings.proposals) {
            one.alternative += std::find(p.alternatives.begin(), p.alternatives.end(),
                                         result.readings[a].id) != p.alternatives.end();
        }
        written = read_by_instruments(truth, 9000u + unsigned(i));
        std::size_t b = a;
        while (b == a && checked.size() > 1) {
            b = checked[std::uniform_int_distribution<std::size_t>(0, checked.size() - 1)(random)];
        }
        plant(written, a);
        plant(written, b);
        const FitResult both = fit(truth, written);
        ++two.tried;
        two.seen += both.status == FitStatus::contradictory;
        two.named += names(both, a) && names(both, b);
    }
    if (one.tried == 0) return;
    const auto percent = [](int part, int whole) { return 100.0 * part / whole; };
    fmt::print(
        "{:16} {:4.0f} sigma, {} of {} readings can be checked: seen {:.1f} %, named first "
        "{:.1f} %, named {:.1f} %, as alternative {:.1f} %; of two both named {:.1f} %\n",
        which.name, size, checked.size(), valued, percent(one.seen, one.tried),
        percent(one.named_first, one.tried), percent(one.named, one.tried),
        percent(one.alternative, one.tried), percent(two.named, two.tried));
    std::fflush(stdout);
}

}  // namespace

}  // namespace culet::bench

int main(int argc, char** argv) {
    using namespace culet::bench;
    CLI::App app("Honesty of the fit's uncertainties, and what errors it finds");
    int stones_of_each = 1, repetitions = 500, plants = 200;
    std::string only;
    app.add_option("--stones", stones_of_each, "stones of each kind");
    app.add_option("--repetitions", repetitions, "noisy readings of each stone");
    app.add_option("--plants", plants, "planted errors of each stone");
    app.add_option("--only", only, "stones whose name contains this");
    CLI11_PARSE(app, argc, argv);
    const std::vector<Sample> stones{
        {"round, 8-fold", TruthKind::round, true}, {"round, none", TruthKind::round, false},
        {"step, 2-fold", TruthKind::step, true},   {"step, none", TruthKind::step, false},
        {"pear", TruthKind::pear, false},          {"trillion", TruthKind::trillion, true}};
    fmt::print(
        "{} stones of each kind, {} noisy repetitions. To reach: within 1 sigma 68 +- 3 %, 2 sigma "
        "95 +- 2 %, error over Cramer-Rao <= 1.05, false alarms <= 2 %\n",
        stones_of_each, repetitions);
    fmt::print("{:16} {:12} {:>7} {:>7} {:>9}\n", "stone", "of", "1 sigma", "2 sigma", "/limit");
    for (const Sample& s : stones) {
        if (s.name.find(only) != std::string::npos && repetitions > 0) {
            report_coverage(s, stones_of_each, repetitions);
        }
    }
    fmt::print(
        "Errors planted. To reach: one of 10 sigma named wherever its redundancy allows, of "
        "two both named in 80 %\n");
    for (const Sample& s : stones) {
        if (s.name.find(only) != std::string::npos && plants > 0) report_detection(s, plants, 10);
    }
    return 0;
}
