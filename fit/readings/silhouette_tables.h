#pragma once
// The [[silhouette]] tables of a stone file.

#include <vector>

#include "fit/readings/measurement.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Returns one written reading of kind `silhouette` for each table. Throws InputError with file and
/// line.
std::vector<WrittenReading> read_silhouettes(const TomlTable& root);

}  // namespace culet
