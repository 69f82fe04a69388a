#pragma once
// Values that several tables of a scene file have. All throw InputError with file and line.

#include "render/scene/objects.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Three numbers that are no zero vector, made unit.
Vec3 direction_in(const TomlTable& table, const char* key);
Vec3 point_in(const TomlTable& table, const char* key);
double positive_in(const TomlTable& table, const char* key);

/// Of what a picture can hold: 0, or 1e-36 to 1e36.
double checked_radiance(const TomlTable& table, const char* key, double value);
/// `radiance`: a number, [r, g, b], or an illuminant by name; 1 where there is none.
LightColour unpolarised_radiance_in(const TomlTable& table);

/// A number or [r, g, b], none below 0.
SurfaceColour colour_in(const TomlTable& table, const char* key);
/// The same, none above 1; `usual` where there is none.
SurfaceColour share_in(const TomlTable& table, const char* key, double usual);

}  // namespace culet
