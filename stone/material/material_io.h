#pragma once
// Materials that the user writes: the [material] table.

#include "stone/material/material.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Throws InputError with the line that is wrong.
Material material_of(const TomlTable& table);

/// The file has one [material] table.
Material read_material(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {});

/// Resolves the option --material: a material file if the name ends in .toml, else a name of the
/// catalogue.
Material material_called(const std::string& name);

}  // namespace culet
