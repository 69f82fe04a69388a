#pragma once
// Other worlds than the model's: what the photograph might be of instead.

#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// The stone turned about a point, its crystal with it.
Stone turned_stone(const Stone& stone, const glm::dmat3& turn, const Vec3& about);

/// True when turning the lights changes nothing: the same light from everywhere.
bool same_light_from_everywhere(const Lights& lights);

/// The stone with all its refractive indices `by` higher, whatever their form.
Material with_index_changed(const Material& material, double by);
/// With its indices at the sodium line at all wavelengths.
Material without_dispersion(const Material& material);
Material with_absorption_times(const Material& material, double factor);

/// The materials of the catalogue whose mean index at the sodium line lies nearest, of other
/// indices than this one's (by 0.002 at least), nearest first. They keep this one's absorption, so
/// that it is the index that is asked about.
std::vector<Material> neighbouring_materials(const Material& material, int count);

}  // namespace culet
