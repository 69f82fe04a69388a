#pragma once
// Reads the stone file (TOML): its tables [stone] and [material]. The readings and [fit] in the
// same file belong to the fit.

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

/// Throws InputError. Reads the mesh but does not check it: run `find_faults`.
StoneFile read_stone(const std::filesystem::path& file,
                     const std::vector<std::string>& overrides = {});

/// The same for a parsed file: [stone] and, beside it, [material].
StoneFile stone_of(const TomlTable& root);

/// Throws InputError when `stone`, read from `file`, has no material.
void require_material(const StoneFile& stone, const std::filesystem::path& file);

/// The material that a table's `material` names (in the catalogue, or a material file *.toml), or
/// else the [material] table beside it. Throws InputError when there is neither.
Material material_named_in(const TomlTable& table, const TomlTable& root);

/// `optic_axis` or `principal_axes`, made orthonormal; identity when neither is given.
CrystalFrame crystal_frame_in(const TomlTable& table, OpticCharacter optic);

}  // namespace culet
