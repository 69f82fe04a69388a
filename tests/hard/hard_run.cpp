#include "tests/hard/hard_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/time.h>
#include <unistd.h>

#include <cfenv>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet::hard {

namespace {

using Json = nlohmann::ordered_json;

constexpr double k_last_place = 2.220446049250313e-16;

#ifdef CULET_SLOW_BUILD
constexpr double k_patience = 20;
#else
constexpr double k_patience = 1;
#endif

const std::map<std::string, MakeSubject>& kinds() {
    static const std::map<std::string, MakeSubject> all{
        {"solid", solid_subject},          {"face", face_subject},
        {"crystal", crystal_subject},      {"ray", ray_subject},
        {"picture", picture_subject},      {"fit", fit_subject},
        {"photograph", photograph_subject}};
    return all;
}

extern "C" void give_up(int) {
    constexpr char words[] = "hard case: took longer than its `seconds`\n";
    [[maybe_unused]] const auto written = write(2, words, sizeof words - 1);
    std::_Exit(1);
}

// JSON has no infinity and no NaN.
Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Measured measured(const Measure& measure, bool may_be_refused = false) {
    try {
        return measure();
    } catch (const InputError& error) {
        return {may_be_refused ? 0 : std::nan(""), std::nan(""),
                fmt::format("was refused: {}", error.what())};
    } catch (const std::exception& error) {
        return {std::nan(""), std::nan(""), fmt::format("threw: {}", error.what())};
    }
}

// 0/0, comparisons with NaN and the like set this flag.
bool invalid_operation() {
    return std::fetestexcept(FE_INVALID) != 0;
}

// Counts the program's own time, so that a busy machine does not look like a hang. The test's time
// limit catches what waits for ever.
void set_limit(double seconds) {
    std::signal(SIGPROF, give_up);
    itimerval limit{};
    limit.it_value.tv_sec = static_cast<time_t>(seconds);
    setitimer(ITIMER_PROF, &limit, nullptr);
}

Json run_point(const HardCase& hard_case, const HardPoint& point) {
    Json row{{"x", number(point.x)}, {"label", point.label}};
    const std::string where =
        fmt::format("{}: {} {}", hard_case.file.string(), hard_case.x_label, point.label);
    Subject subject;
    try {
        subject = kinds().at(hard_case.kind)(hard_case, point,
                                             read_toml(hard_case.file, point.overrides));
    } catch (const InputError& error) {
        if (!hard_case.may_be_refused) ADD_FAILURE() << where << ": was refused: " << error.what();
        return row;
    } catch (const std::exception& error) {
        ADD_FAILURE() << where << ": could not be made: " << error.what();
        return row;
    }
    for (const auto& [name, allowed] : hard_case.invariants) {
        const auto found = subject.invariants.find(name);
        if (found == subject.invariants.end()) {
            ADD_FAILURE() << where << ": cases of this kind have no invariant \"" << name << '"';
            continue;
        }
        std::feclearexcept(FE_INVALID);
        const Measured m = measured(found->second, hard_case.may_be_refused);
        const bool invalid = hard_case.no_invalid_operations && invalid_operation();
        const double inherent =
            std::isfinite(m.condition) ? allowed.per_condition * m.condition * k_last_place : 0;
        const double by_x = std::isfinite(point.x) ? allowed.per_x * std::abs(point.x) : 0;
        const double limit = std::max({allowed.limit, inherent, by_x});
        const bool holds = m.error <= limit && !invalid;
        EXPECT_TRUE(holds) << where << "\n  " << name << ": "
                           << fmt::format("{:.3g}, allowed {:.3g}", m.error, limit)
                           << (invalid ? ", and an invalid floating-point operation" : "")
                           << (m.about.empty() ? "" : "\n  ") << m.about;
        row["invariants"][name] = {{"error", number(m.error)},
                                   {"limit", number(limit)},
                                   {"condition", number(m.condition)},
                                   {"holds", holds}};
    }
    for (const Subject::Contrast& contrast : subject.contrasts) {
        row["contrasts"].push_back({{"name", contrast.name},
                                    {"invariant", contrast.invariant},
                                    {"error", number(measured(contrast.measure).error)}});
    }
    return row;
}

}  // namespace

void run_case(const HardCase& hard_case, const std::filesystem::path& results) {
    ASSERT_TRUE(kinds().contains(hard_case.kind))
        << hard_case.file << ": there are no cases of kind \"" << hard_case.kind << '"';
    set_limit(k_patience * hard_case.seconds);
    if (std::getenv("CULET_HARD_TRAP") != nullptr) feenableexcept(FE_INVALID);  // for a debugger
    Json rows = Json::array();
    for (const HardPoint& point : hard_case.points) rows.push_back(run_point(hard_case, point));
    set_limit(0);
    const Json result{{"section", hard_case.section},
                      {"name", hard_case.name},
                      {"title", hard_case.title},
                      {"why", hard_case.why},
                      {"x_label", hard_case.x_label},
                      {"log_x", hard_case.log_x},
                      {"points", rows}};
    std::filesystem::create_directories(results);
    write_text(results / fmt::format("{}.{}.json", hard_case.section, hard_case.name),
               result.dump(1) + "\n");
}

}  // namespace culet::hard
