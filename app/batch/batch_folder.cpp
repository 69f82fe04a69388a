#include "app/batch/batch_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <vector>

#include "app/batch/batch_work.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t k_most_shares = 100000;
constexpr const char* k_lock_file = ".lock";
constexpr int k_tries = 100;
constexpr std::chrono::milliseconds k_pause{10};

void make_folder(const fs::path& folder) {
    std::error_code problem;
    if (fs::exists(folder, problem) && !fs::is_directory(folder, problem))
        throw InputError(folder, "is a file: -o names the folder for the results");
    fs::create_directories(folder, problem);
    if (problem) throw InputError(folder, fmt::format("cannot be made: {}", problem.message()));
}

// The last process that leaves removes the lock's file; -1 if that happened meanwhile. Throws
// InputError if another process keeps the lock for `tries` pauses.
int try_lock(const fs::path& folder, int tries) {
    const fs::path file = folder / k_lock_file;
    const int lock = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock < 0) {
        if (errno == ENOENT) return -1;
        throw InputError(folder, fmt::format("cannot be written: {}", std::strerror(errno)));
    }
    bool taken = true;
    for (int i = 0; taken && i < tries; ++i) {
        if (i > 0) std::this_thread::sleep_for(k_pause);
        taken = ::flock(lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    }
    if (taken) {
        ::close(lock);
        throw InputError(folder,
                         "another culet batch is running on this share: wait until it ends");
    }
    struct stat status {};
    if (::fstat(lock, &status) == 0 && status.st_nlink > 0) return lock;
    ::close(lock);
    return -1;
}

}  // namespace

BatchShare share_in(const std::string& text) {
    BatchShare share;
    if (text.empty()) return share;
    const char* const end = text.data() + text.size();
    const auto [slash, no_number] = std::from_chars(text.data(), end, share.number);
    bool good = no_number == std::errc() && slash != end && *slash == '/';
    if (good) {
        const auto [stop, no_count] = std::from_chars(slash + 1, end, share.of);
        good = no_count == std::errc() && stop == end;
    }
    if (!good || share.of < 1 || share.of > k_most_shares || share.number >= share.of)
        throw InputError(
            fmt::format("--shard is K/N with K from 0 to N - 1, as 0/50 to 49/50; "
                        "found \"{}\"",
                        text));
    return share;
}

fs::path job_folder(const fs::path& folder, const std::string& name) {
    return folder / "jobs" / name;
}

std::string work_name(const BatchShare& share) {
    return fmt::format("share-{}-of-{}", share.number, share.of);
}

BatchFolder::BatchFolder(fs::path folder, const std::string& work) : folder_(std::move(folder)) {
    make_folder(folder_);
    make_folder(folder_ / "jobs");
    work_ = folder_ / "unfinished" / work;
    for (int i = 0; lock_ < 0 && i < k_tries; ++i) {
        // Another share that ends now may remove `unfinished` in between.
        std::error_code problem;
        fs::create_directories(work_, problem);
        if (problem && problem != std::errc::no_such_file_or_directory)
            throw InputError(work_, fmt::format("cannot be made: {}", problem.message()));
        // A worker of a killed batch holds its lock until it is killed too, a moment later.
        lock_ = try_lock(work_, k_tries);
    }
    if (lock_ < 0)
        throw InputError(work_, "appears and disappears: is another culet batch running?");
    // Remove what a killed process left.
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(work_, ignored)) {
        if (entry.path().filename() != k_lock_file) fs::remove_all(entry.path(), ignored);
    }
}

BatchFolder::~BatchFolder() {
    std::error_code ignored;
    fs::remove_all(work_, ignored);
    // Succeeds only if no other share is at work.
    fs::remove(folder_ / "unfinished", ignored);
    ::close(lock_);
}

void remove_unfinished(const fs::path& folder) {
    std::error_code ignored;
    std::vector<fs::path> shares;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "unfinished", ignored))
        shares.push_back(entry.path());
    for (const fs::path& share : shares) {
        try {
            const int lock = try_lock(share, 1);
            fs::remove_all(share, ignored);
            if (lock >= 0) ::close(lock);
        } catch (const InputError&) {
            // This share is at work.
        }
    }
    fs::remove(folder / "unfinished", ignored);
}

std::optional<JobEnd> BatchFolder::end_of(const std::string& name) const {
    const fs::path file = job_folder(folder_, name) / k_job_record;
    std::error_code problem;
    if (!fs::exists(file, problem)) return {};
    const auto record = nlohmann::json::parse(read_text(file), nullptr, false);
    if (!record.is_object()) return {};
    return JobEnd{record.value("fingerprint", ""), record.value("exit_code", -1)};
}

fs::path BatchFolder::begin(const std::string& name) const {
    drop(name);
    make_folder(work_ / name);
    return work_ / name;
}

void BatchFolder::finish(const std::string& name) const {
    const fs::path from = work_ / name, to = job_folder(folder_, name);
    std::error_code problem;
    if (fs::exists(to, problem)) {
        const fs::path old = work_ / (name + ".old");
        fs::rename(to, old, problem);
        fs::remove_all(old, problem);
    }
    fs::rename(from, to, problem);
    if (problem) throw InputError(to, fmt::format("cannot be written: {}", problem.message()));
}

void BatchFolder::write(const std::string& name, const std::string& text) const {
    write_text(work_ / name, text);
    std::error_code problem;
    fs::rename(work_ / name, folder_ / name, problem);
    if (problem)
        throw InputError(folder_ / name, fmt::format("cannot be written: {}", problem.message()));
}

void BatchFolder::drop(const std::string& name) const {
    std::error_code ignored;
    fs::remove_all(work_ / name, ignored);
}

}  // namespace culet
