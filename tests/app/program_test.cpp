#include "tests/app/program_test.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

extern char** environ;

namespace culet::test {

namespace {

std::string content(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

double seconds_of(pid_t child) {
    clockid_t clock{};
    timespec time{};
    if (::clock_getcpuclockid(child, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The exit status; `stop_at` as in run_culet.
int wait_for(pid_t child, double stop_at, double& cpu_after_stop) {
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    double stopped_at = -1;
    rusage used{};
    int status = 0;
    while (::wait4(child, &status, stop_at > 0 && stopped_at < 0 ? WNOHANG : 0, &used) != child) {
        ::usleep(1000);
        if (stopped_at >= 0 || !(seconds_of(child) >= stop_at)) continue;
        stopped_at = seconds_of(child);
        ::kill(child, SIGTERM);
    }
    if (stopped_at >= 0)
        cpu_after_stop = seconds(used.ru_utime) + seconds(used.ru_stime) - stopped_at;
    return status;
}

// Keeps the JSON that a run wrote, in files or on its output, for the test of the schemas.
void keep_json(const std::vector<std::string>& arguments, const std::string& out) {
    const char* folder = std::getenv("CULET_KEPT_JSON");
    if (folder == nullptr) return;
    static int number = 0;
    const auto kept = [&] {
        return std::filesystem::path(folder) / (std::to_string(++number) + ".json");
    };
    if (out.starts_with("{")) std::ofstream(kept()) << out;
    std::error_code missing;
    for (const std::string& file : arguments) {
        if (file.ends_with(".json")) std::filesystem::copy_file(file, kept(), missing);
    }
}

}  // namespace

ProgramRun run_culet(const std::vector<std::string>& arguments, double stop_at) {
    std::string pattern = (std::filesystem::temp_directory_path() / "culet-run-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) return {};
    const std::filesystem::path folder = pattern, out = folder / "out", err = folder / "err";
    std::vector<std::string> words{CULET_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_CREAT | O_WRONLY, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_CREAT | O_WRONLY, 0600);
    ProgramRun run;
    pid_t child = 0;
    if (::posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ) == 0) {
        const int status = wait_for(child, stop_at, run.cpu_after_stop);
        if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
    }
    posix_spawn_file_actions_destroy(&actions);
    run.out = content(out);
    run.err = content(err);
    keep_json(arguments, run.out);
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
    return run;
}

std::string ProgramTest::refusal_of(const ProgramRun& run) {
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_TRUE(run.err.starts_with("culet: error: ")) << run.err;
    return run.err;
}

std::string ProgramTest::refusal(const std::vector<std::string>& arguments) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    return refusal_of(run_culet(arguments));
}

void ProgramTest::cut(const std::string& kind, const std::string& name) const {
    ASSERT_EQ(run_culet({"cut", kind, "-o", file(name), "-q"}).exit_code, 0);
}

nlohmann::json ProgramTest::json(const std::string& name) const {
    return nlohmann::json::parse(text(name));
}

}  // namespace culet::test
