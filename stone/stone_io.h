#pragma once
// Reads the stone file (TOML): [stone] and [material]. Readings and [fit] belong to the fit.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stone/stone.h"
#include "stone/text/toml_file.h"

namespace culet {

struct StoneFile {
    Stone stone;
    /// False: `stone.material` holds at most a density. A fit may do without a material.
    bool has_material = true;
    bool states_convex = false;  ///< false: `stone.convex` is only assumed
    std::filesystem::path mesh_file;
    std::filesystem::path readings_file;  ///< empty: none named
    std::vector<std::string> notes;       ///< from reading the mesh
    std::vector<std::string> details;     ///< further notes, shown on request
};

/// Throws InputError. Does not check the mesh: run `find_faults`.
StoneFile read_stone(const std::filesystem::path& file,
                     const std::vector<std::string>& overrides = {});

/// The same for a parsed file: [stone] and, beside it, [material].
StoneFile stone_of(const TomlTable& root);

/// Throws InputError, for `file`, if the stone has no material.
void require_material(const StoneFile& stone, const std::filesystem::path& file);

/// The material that the table's `material` names (catalogue or *.toml), or else the [material]
/// table beside it. Throws InputError when there is neither.
Material material_named_in(const TomlTable& table, const TomlTable& root);

/// Reads `optic_axis` or `principal_axes` and makes them orthonormal; identity when neither is
/// given.
CrystalFrame crystal_frame_in(const TomlTable& table, OpticCharacter optic);

}  // namespace culet
