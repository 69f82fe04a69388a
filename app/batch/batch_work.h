#pragma once
// One job of a batch: fits, grades and draws its stone.

#include <filesystem>
#include <string>

#include "app/batch/batch_jobs.h"

namespace culet {

/// Says how a job ended.
inline constexpr const char* k_job_record = "job.json";

/// Fits the stone if it has readings, grades and draws it, and writes everything with the job's
/// record to `folder`, on one thread. Returns the record's exit code. Call it in a process of its
/// own: it changes the working directory to the batch's folder, so that names and messages do not
/// depend on where that is. Throws InputError when the results cannot be written.
int work_on_job(const BatchList& list, const BatchJob& job, const BatchSettings& settings,
                const std::string& fingerprint, const std::filesystem::path& folder);

/// Writes the record of a job that ended without one; `message` says how.
void write_failure(const BatchJob& job, const std::string& fingerprint, int exit_code,
                   const std::string& message, const std::filesystem::path& folder);

}  // namespace culet
