#pragma once
// The cutting sheet as the bench shows it, step by step, and the marks of steps that are done.

#include <filesystem>
#include <set>
#include <string>

#include "studio/export_work.h"

namespace culet {

/// JSON: `drawn`, the mesh, and after a fit `fitted`, each with `about` and `note`, one line each,
/// and `steps`: tier, part, angle (with its sigma after a fit), indices, depth, facets, and whether
/// `marks` has it done. Throws InputError.
std::string bench_json(const LoadedStone& loaded, const FittedStone& fitted,
                       const std::filesystem::path& marks, int opened);

/// NAME-bench.txt beside the stone file: of every step that is done a line with its number and
/// tier. Throws InputError if it lies outside of the folder.
std::filesystem::path marks_file(const std::filesystem::path& stone_file);
/// Its lines; none without a file. Throws InputError.
std::set<std::string> marks_in(const std::filesystem::path& file);
/// Adds or removes a line, at once. The others stay, also those of steps that are no longer there.
/// Throws InputError.
void mark(const std::filesystem::path& file, std::size_t step, const std::string& tier, bool done);

}  // namespace culet
