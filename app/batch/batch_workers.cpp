#include "app/batch/batch_workers.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <map>

#include "app/batch/batch_plan.h"
#include "app/batch/batch_work.h"
#include "app/program/terminal.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double cpu_seconds_of(const rusage& usage) {
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// A cluster gives a job only some of a machine's processors.
int usable_processors() {
    cpu_set_t set;
    CPU_ZERO(&set);
    return sched_getaffinity(0, sizeof set, &set) == 0 ? std::max(1, CPU_COUNT(&set)) : 1;
}

// Blocks SIGCHLD so that it can be waited for.
class HeldChildSignal {
public:
    HeldChildSignal() {
        sigemptyset(&child_);
        sigaddset(&child_, SIGCHLD);
        sigprocmask(SIG_BLOCK, &child_, &before_);
    }
    ~HeldChildSignal() { restore(); }
    HeldChildSignal(const HeldChildSignal&) = delete;
    HeldChildSignal& operator=(const HeldChildSignal&) = delete;

    void restore() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }
    /// Waits until a child ends, a signal comes, or a quarter of a second has passed.
    void wait() const {
        const timespec most{0, 250000000};
        sigtimedwait(&child_, nullptr, &most);
    }

private:
    sigset_t child_{}, before_{};
};

struct AtWork {
    std::size_t job = 0;
    std::string fingerprint;
    Clock::time_point start;
};

class Workers {
public:
    Workers(const BatchList& list, const BatchSettings& settings, const BatchFolder& folder,
            const ShareOptions& options)
        : list_(list), settings_(settings), folder_(folder), options_(options) {
        fflush(nullptr);
    }
    // No job outlives the batch, however that ends.
    ~Workers() {
        for (const auto& [child, work] : at_work_) ::kill(child, SIGKILL);
        for (const auto& [child, work] : at_work_) ::waitpid(child, nullptr, 0);
    }
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    std::size_t busy() const { return at_work_.size(); }
    void wait() const { signals_.wait(); }

    void start(std::size_t number, std::string fingerprint) {
        const BatchJob& job = list_.jobs[number];
        const fs::path folder = folder_.begin(job.name);
        const pid_t parent = ::getpid();
        const pid_t child = ::fork();
        if (child < 0)
            throw InputError(
                fmt::format("no process can be started: {}; fewer at a time with --threads N",
                            std::strerror(errno)));
        if (child == 0) become_worker(job, fingerprint, folder, parent);
        at_work_[child] = {number, std::move(fingerprint), Clock::now()};
    }

    /// Moves ended jobs to the finished ones and counts them.
    std::size_t collect() {
        std::size_t ended = 0;
        int status = 0;
        rusage usage{};
        for (pid_t child = 0; (child = ::wait4(-1, &status, WNOHANG, &usage)) > 0;) {
            const auto found = at_work_.find(child);
            if (found == at_work_.end()) continue;
            const AtWork work = found->second;
            at_work_.erase(found);
            cpu_seconds_ += cpu_seconds_of(usage);
            end_job(work, status);
            ++ended;
        }
        return ended;
    }

    double cpu_seconds() const { return cpu_seconds_; }
    std::size_t bad() const { return bad_; }

private:
    [[noreturn]] void become_worker(const BatchJob& job, const std::string& fingerprint,
                                    const fs::path& folder, pid_t parent) const {
        // The child ends with its parent, even if that is killed.
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) ::_exit(exit_interrupted);
        // The lock, Ctrl-C and the terminal belong to the parent alone.
        ::close(folder_.lock());
        std::signal(SIGINT, SIG_IGN);
        std::signal(SIGTERM, SIG_DFL);
        signals_.restore();
        const int nowhere = ::open("/dev/null", O_RDWR);
        for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
            ::dup2(nowhere, stream);
        int code = exit_internal;
        try {
            code = work_on_job(list_, job, settings_, fingerprint, folder);
        } catch (const InputError&) {
            code = exit_impossible;  // the record is missing: the parent reports that
        } catch (...) {
        }
        ::_exit(code);
    }

    void end_job(const AtWork& work, int status) {
        const BatchJob& job = list_.jobs[work.job];
        const fs::path folder = folder_.begun(job.name);
        std::error_code problem;
        if (WIFSIGNALED(status)) {
            // What it wrote may be incomplete.
            write_failure(job, work.fingerprint, exit_internal, died_of(WTERMSIG(status)),
                          folder_.begin(job.name));
        } else if (!fs::exists(folder / k_job_record, problem)) {
            write_failure(job, work.fingerprint, WEXITSTATUS(status),
                          "its results could not be written", folder_.begin(job.name));
        }
        folder_.finish(job.name);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != exit_good) ++bad_;
        say(fmt::format("{}: exit code {}, {:.2f} s", job.name,
                        WIFEXITED(status) ? WEXITSTATUS(status) : exit_internal,
                        seconds_since(work.start)),
            !options_.verbose);
    }

    static std::string died_of(int signal) {
        return fmt::format("its process was ended by signal {} ({}){}", signal, strsignal(signal),
                           signal == SIGKILL ? ": was there too little memory?" : "");
    }

    const BatchList& list_;
    const BatchSettings& settings_;
    const BatchFolder& folder_;
    const ShareOptions& options_;
    HeldChildSignal signals_;
    std::map<pid_t, AtWork> at_work_;
    double cpu_seconds_ = 0;
    std::size_t bad_ = 0;
};

void refuse_results(const BatchList& list, const BatchFolder& folder, const BatchShare& share) {
    for (std::size_t i = 0; i < list.jobs.size(); ++i) {
        std::error_code problem;
        const fs::path there = job_folder(folder.path(), list.jobs[i].name);
        if (share.has(i) && fs::exists(there, problem))
            throw InputError(
                there,
                "exists already: --resume continues with these results, another -o keeps them");
    }
}

void keep_plan(const std::string& plan, const BatchFolder& folder, bool resume) {
    const fs::path file = folder.path() / k_plan_file;
    std::error_code problem;
    const bool there = fs::exists(file, problem);
    if (there && read_text(file) == plan) return;
    if (there && !resume)
        throw InputError(file,
                         "is of another batch or other settings: --resume redoes what has changed, "
                         "another -o keeps these results");
    folder.write(k_plan_file, plan);
}

}  // namespace

ShareResult work_on_share(const BatchList& list, const BatchSettings& settings, const fs::path& out,
                          const ShareOptions& options) {
    const Clock::time_point start = Clock::now();
    const BatchFolder folder(out, work_name(options.share));
    if (!options.resume) refuse_results(list, folder, options.share);
    keep_plan(batch_plan_json(list, settings), folder, options.resume);
    std::vector<std::size_t> jobs;
    for (std::size_t i = 0; i < list.jobs.size(); ++i) {
        if (options.share.has(i)) jobs.push_back(i);
    }
    const std::size_t at_a_time =
        static_cast<std::size_t>(options.workers > 0 ? options.workers : usable_processors());
    const Progress progress = progress_line("batch", options.quiet);
    ShareResult result;
    Workers workers(list, settings, folder, options);
    for (std::size_t next = 0; next < jobs.size() || workers.busy() > 0;) {
        while (next < jobs.size() && workers.busy() < at_a_time) {
            const BatchJob& job = list.jobs[jobs[next]];
            std::string fingerprint = fingerprint_of(list, job, settings);
            const auto end = folder.end_of(job.name);
            // Failures are tried again: the cause (too little memory, a full disk) may be gone.
            const bool keep = end && end->fingerprint == fingerprint &&
                              (end->exit_code == exit_good || end->exit_code == exit_untrusted);
            if (keep) {
                ++result.kept;
                result.bad += end->exit_code == exit_good ? 0 : 1;
            } else {
                workers.start(jobs[next], std::move(fingerprint));
            }
            ++next;
        }
        if (workers.busy() > 0) workers.wait();
        result.worked += workers.collect();
        const double done = static_cast<double>(result.worked + result.kept);
        if (!progress(done / static_cast<double>(jobs.size()))) throw Interrupted();
    }
    result.bad += workers.bad();
    result.cpu_seconds = workers.cpu_seconds();
    result.seconds = seconds_since(start);
    return result;
}

}  // namespace culet
