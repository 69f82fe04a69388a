#include "studio/apart.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>

#include "stone/text/errors.h"

namespace culet {

namespace {

// What the copy writes into its pipe: any number of `progress`, each with a double, then one end
// with its text, up to the end of the pipe.
enum class Word : char { progress = 'p', done = 'd', failed = 'f', stopped = 's' };

void put(int pipe, const void* bytes, std::size_t size) {
    const char* at = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t written = write(pipe, at, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) _exit(1);
        at += written;
        size -= static_cast<std::size_t>(written);
    }
}

void put_end(int pipe, Word word, const std::string& text) {
    put(pipe, &word, 1);
    put(pipe, text.data(), text.size());
}

[[noreturn]] void be_the_copy(const std::function<std::string(const Progress&)>& work, int pipe) {
    leave_the_studio(pipe);
    const Progress progress = [pipe](double fraction) {
        const Word word = Word::progress;
        put(pipe, &word, 1);
        put(pipe, &fraction, sizeof fraction);
        return true;
    };
    try {
        put_end(pipe, Word::done, work(progress));
    } catch (const Interrupted&) {
        put_end(pipe, Word::stopped, "");
    } catch (const InputError& error) {
        put_end(pipe, Word::failed, error.what());
    } catch (const std::bad_alloc&) {
        put_end(pipe, Word::failed, "not enough memory for this");
    } catch (const std::exception& error) {
        put_end(pipe, Word::failed, fmt::format("{} (an error in culet itself)", error.what()));
    } catch (...) {
        put_end(pipe, Word::failed, "unknown failure (an error in culet itself)");
    }
    // Without the destructors of what the studio owns.
    _exit(0);
}

// Takes what is whole off the front: reports of progress.
void take_progress(std::string& read, double& fraction) {
    constexpr std::size_t k_report = 1 + sizeof(double);
    std::size_t at = 0;
    while (read.size() >= at + k_report && read[at] == static_cast<char>(Word::progress)) {
        std::memcpy(&fraction, read.data() + at + 1, sizeof fraction);
        at += k_report;
    }
    read.erase(0, at);
}

}  // namespace

void leave_the_studio(int kept) {
    // The copy would hold the studio's connections open, and outlive it.
    if (kept > 3) syscall(SYS_close_range, 3, kept - 1, 0);
    syscall(SYS_close_range, kept + 1, ~0U, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGPIPE, SIG_DFL);
}

WorkEnd run_apart(const std::function<std::string(const Progress&)>& work, std::mutex& quiet,
                  const Progress& progress) {
    int ends[2];
    if (pipe(ends) != 0) return {WorkEnd::How::failed, "no pipe can be opened for the work"};
    std::unique_lock lock(quiet);
    const pid_t copy = fork();
    if (copy == 0) be_the_copy(work, ends[1]);
    lock.unlock();
    close(ends[1]);
    std::string read;
    bool stopped = copy < 0;
    for (double fraction = 0; !stopped;) {
        pollfd waiting{ends[0], POLLIN, 0};
        constexpr int k_step_ms = 50;
        if (poll(&waiting, 1, k_step_ms) > 0) {
            char bytes[1 << 16];
            const ssize_t got = ::read(ends[0], bytes, sizeof bytes);
            if (got == 0) break;
            if (got > 0) read.append(bytes, static_cast<std::size_t>(got));
            take_progress(read, fraction);
        }
        stopped = progress && !progress(fraction);
    }
    close(ends[0]);
    if (copy < 0) return {WorkEnd::How::failed, "no process can be started for the work"};
    if (stopped) kill(copy, SIGKILL);
    int status = 0;
    while (waitpid(copy, &status, 0) < 0 && errno == EINTR) {
    }
    const Word word = read.empty() ? Word::progress : static_cast<Word>(read.front());
    if (stopped || word == Word::stopped) return {WorkEnd::How::stopped, {}};
    if (word == Word::done) return {WorkEnd::How::done, read.substr(1)};
    if (word == Word::failed) return {WorkEnd::How::failed, read.substr(1)};
    return {WorkEnd::How::failed,
            WIFSIGNALED(status)
                ? fmt::format("the work crashed ({}): an error in culet itself, please report it",
                              strsignal(WTERMSIG(status)))
                : "the work ended without a result (an error in culet itself)"};
}

}  // namespace culet
