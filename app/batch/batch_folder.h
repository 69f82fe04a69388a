#pragma once
// The folder of a batch's results: jobs.json, the plan; jobs/NAME, a finished job; and while it is
// worked on, unfinished/share-K-of-N/NAME for a job and unfinished/table for what is made of all.

#include <filesystem>
#include <optional>
#include <string>

namespace culet {

inline constexpr const char* k_plan_file = "jobs.json";

/// One share of a batch: the jobs whose number, from 0, leaves `number` over when divided by `of`.
struct BatchShare {
    std::size_t number = 0, of = 1;

    bool has(std::size_t job) const { return job % of == number; }
};

/// `K/N` with K from 0 to N - 1; empty: all of it. Throws InputError.
BatchShare share_in(const std::string& text);

/// How a finished job ended, by its record.
struct JobEnd {
    std::string fingerprint;
    int exit_code = 0;
};

/// The name of what works on a share.
std::string work_name(const BatchShare& share);

/// While it lives no other process does the work of this name. Throws InputError: the folder cannot
/// be made or written, or another process is at work.
class BatchFolder {
public:
    BatchFolder(std::filesystem::path folder, const std::string& work);
    /// What is unfinished is removed.
    ~BatchFolder();
    BatchFolder(const BatchFolder&) = delete;
    BatchFolder& operator=(const BatchFolder&) = delete;

    /// Nothing for a job that is not finished.
    std::optional<JobEnd> end_of(const std::string& name) const;
    /// An empty folder to work in.
    std::filesystem::path begin(const std::string& name) const;
    /// Where it is.
    std::filesystem::path begun(const std::string& name) const { return work_ / name; }
    /// The work becomes the finished job at once and whole; one that was there before goes.
    void finish(const std::string& name) const;
    /// A file of the folder itself, at once and whole; what is half written when the process is
    /// killed lies among the unfinished.
    void write(const std::string& name, const std::string& text) const;
    /// Away with what was begun.
    void drop(const std::string& name) const;
    /// The lock's file: a child process closes it.
    int lock() const { return lock_; }

    const std::filesystem::path& path() const { return folder_; }

private:
    std::filesystem::path folder_, work_;
    int lock_ = -1;
};

/// Away with what processes left that were killed; shares that are at work are let be.
void remove_unfinished(const std::filesystem::path& folder);

/// Where a finished job is.
std::filesystem::path job_folder(const std::filesystem::path& folder, const std::string& name);

}  // namespace culet
