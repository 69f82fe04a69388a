#pragma once
// One job of a batch: its stone fitted, graded and drawn.

#include <filesystem>
#include <string>

#include "app/batch/batch_jobs.h"

namespace culet {

/// What stands in a job's folder beside its results; it says how the job ended.
inline constexpr const char* k_job_record = "job.json";

/// Fits the stone where it has readings, grades it, draws it, and writes all of it, with the job's
/// record, to `folder`, on one thread; returns the exit code of the record. Changes the program's
/// working folder to the batch's, so that names and messages are the same wherever that lies:
/// for a process of its own. Throws InputError when the results cannot be written.
int work_on_job(const BatchList& list, const BatchJob& job, const BatchSettings& settings,
                const std::string& fingerprint, const std::filesystem::path& folder);

/// The record of a job that ended without one: `message` says how.
void write_failure(const BatchJob& job, const std::string& fingerprint, int exit_code,
                   const std::string& message, const std::filesystem::path& folder);

}  // namespace culet
