#pragma once
// Values in several tables of scene files. All functions throw InputError with file and line.

#include "render/scene/objects.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Three numbers, not all zero, normalised.
Vec3 direction_in(const TomlTable& table, const char* key);
Vec3 point_in(const TomlTable& table, const char* key);
double positive_in(const TomlTable& table, const char* key);

/// Refuses what pictures cannot hold: only 0, or 1e-36 to 1e36.
double checked_radiance(const TomlTable& table, const char* key, double value);
/// Reads `radiance`: a number, [r, g, b], or an illuminant's name; 1 if missing.
LightColour unpolarised_radiance_in(const TomlTable& table);

/// A number or [r, g, b], not negative.
SurfaceColour colour_in(const TomlTable& table, const char* key);
/// The same, at most 1; `usual` if missing.
SurfaceColour share_in(const TomlTable& table, const char* key, double usual);

}  // namespace culet
