#pragma once
// The [[silhouette]] tables of a stone file.

#include <vector>

#include "fit/readings/measurement.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Written readings of kind `silhouette`, one a table. Throws InputError with file and line.
std::vector<WrittenReading> read_silhouettes(const TomlTable& root);

}  // namespace culet
