#pragma once
// The folder of a batch's results: jobs.json is the plan, jobs/NAME a finished job. During the
// work, unfinished/share-K-of-N/NAME holds a job, and unfinished/table what is made from all jobs.

#include <filesystem>
#include <optional>
#include <string>

namespace culet {

inline constexpr const char* k_plan_file = "jobs.json";

/// The jobs whose number, from 0, has the remainder `number` when divided by `of`.
struct BatchShare {
    std::size_t number = 0, of = 1;

    bool has(std::size_t job) const { return job % of == number; }
};

/// Reads `K/N`, with K from 0 to N - 1; empty: the whole batch. Throws InputError.
BatchShare share_in(const std::string& text);

/// How a finished job ended, as its record says.
struct JobEnd {
    std::string fingerprint;
    int exit_code = 0;
};

std::string work_name(const BatchShare& share);

/// While it lives, no other process can do the work of this name. Throws InputError when the folder
/// cannot be made or written, or another process is at work.
class BatchFolder {
public:
    BatchFolder(std::filesystem::path folder, const std::string& work);
    /// Removes what is unfinished.
    ~BatchFolder();
    BatchFolder(const BatchFolder&) = delete;
    BatchFolder& operator=(const BatchFolder&) = delete;

    /// Returns nothing for a job that is not finished.
    std::optional<JobEnd> end_of(const std::string& name) const;
    /// Makes an empty folder to work in.
    std::filesystem::path begin(const std::string& name) const;
    /// The folder that `begin` made.
    std::filesystem::path begun(const std::string& name) const { return work_ / name; }
    /// Replaces an earlier job in one step.
    void finish(const std::string& name) const;
    /// A file of the folder itself, in one step: killed half-way, its rest is among the unfinished
    /// jobs.
    void write(const std::string& name, const std::string& text) const;
    void drop(const std::string& name) const;
    /// Child processes must close it.
    int lock() const { return lock_; }

    const std::filesystem::path& path() const { return folder_; }

private:
    std::filesystem::path folder_, work_;
    int lock_ = -1;
};

/// Removes what killed processes left, but nothing of shares that are at work.
void remove_unfinished(const std::filesystem::path& folder);

std::filesystem::path job_folder(const std::filesystem::path& folder, const std::string& name);

}  // namespace culet
