#pragma once
// Materials that the user writes: the [material] table.

#include "stone/material/material.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Reads a [material] table. Throws InputError with the line that is wrong.
Material material_of(const TomlTable& table);

/// Reads a material file, which has one [material] table.
Material read_material(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {});

/// The material that an option --material names: a material file where the name ends in .toml, else
/// one of the catalogue.
Material material_called(const std::string& name);

}  // namespace culet
