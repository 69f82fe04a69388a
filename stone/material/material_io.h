#pragma once
// Materials written by the user: the [material] table.

#include "stone/material/material.h"
#include "stone/text/toml_file.h"

namespace culet {

/// The material of a [material] table. Throws InputError at the line that is wrong.
Material material_of(const TomlTable& table);

/// A material file of its own: one [material] table.
Material read_material(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {});

/// Of an option --material: a name of the catalogue, or a material file where it ends in .toml.
Material material_called(const std::string& name);

}  // namespace culet
