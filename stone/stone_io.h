#pragma once
// The stone file (TOML): [stone] and [material]. Readings and [fit] in the same file belong to the
// fit.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stone/stone.h"
#include "stone/text/toml_file.h"

namespace culet {

struct StoneFile {
    Stone stone;
    /// Else `stone.material` says nothing but a density, where the file does: a fit may do without.
    bool has_material = true;
    bool states_convex = false;  ///< else `stone.convex` is only supposed
    std::filesystem::path mesh_file;
    std::filesystem::path readings_file;  ///< empty: none named
    std::vector<std::string> notes;       ///< from reading the mesh
    std::vector<std::string> details;     ///< the same, said on request
};

/// Throws InputError. The mesh is read but not judged: run `find_faults`.
StoneFile read_stone(const std::filesystem::path& file,
                     const std::vector<std::string>& overrides = {});

/// The same of a parsed file: [stone] and, beside it, [material].
StoneFile stone_of(const TomlTable& root);

/// Throws InputError when the stone that was read from `file` has no material.
void require_material(const StoneFile& stone, const std::filesystem::path& file);

/// `material` of a table that may name one of the catalogue or a material file (*.toml), or else
/// the [material] table beside it. Throws InputError when there is neither.
Material material_named_in(const TomlTable& table, const TomlTable& root);

/// `optic_axis` or `principal_axes`, made orthonormal; identity when neither is given.
CrystalFrame crystal_frame_in(const TomlTable& table, OpticCharacter optic);

}  // namespace culet
