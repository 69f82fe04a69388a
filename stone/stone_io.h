#pragma once
// The stone file (TOML): [stone] and [material]. Readings in the same file belong to the fit.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/stone.h"

namespace culet {

struct StoneFile {
    Stone stone;
    std::filesystem::path mesh_file;
    std::filesystem::path readings_file;  ///< empty: none named
    std::optional<double> density_g_cm3;  ///< of the stone, when the file gives it
    std::vector<std::string> notes;       ///< from reading the mesh
};

/// `overrides` are `key.path=value` settings from the command line. Throws InputError. The mesh is
/// read but not judged: run `find_faults`.
StoneFile read_stone(const std::filesystem::path& file,
                     const std::vector<std::string>& overrides = {});

/// A material file of its own, or the [material] table of a stone or scene file.
Material read_material(const std::filesystem::path& file);

}  // namespace culet
