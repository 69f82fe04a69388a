#pragma once
// Readings of a table that is still being written: a wrong row does not hide the others.

#include <filesystem>
#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// A row that cannot be taken, and why, without the file's name.
struct RowProblem {
    long line = 0;  ///< of the file; 0: not one row is wrong, but all of it
    std::string what;
};

/// As `read_readings` and `read_readings_csv`; rows that cannot be read are named in `problems`,
/// and `skipped`. Throws InputError for what is wrong outside of rows.
std::vector<WrittenReading> read_readings(const std::filesystem::path& stone_file,
                                          std::vector<RowProblem>& problems);
std::vector<WrittenReading> read_readings_csv(const std::filesystem::path& file,
                                              std::vector<RowProblem>& problems);

/// As `bind_readings`; rows that cannot be bound are named in `problems`, and become `skipped`.
/// Empty where no row has a value.
std::vector<Reading> bind_by_row(std::vector<WrittenReading>& written, const Stone& stone,
                                 std::vector<RowProblem>& problems);

}  // namespace culet
