#pragma once
// Changes of the model that the photograph might show instead.

#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

Stone turned_stone(const Stone& stone, const glm::dmat3& turn, const Vec3& about);

/// Whether the same light comes from everywhere, so that turning it changes nothing.
bool same_light_from_everywhere(const Lights& lights);

/// Adds `by` to all refractive indices, in any dispersion formula.
Material with_index_changed(const Material& material, double by);
/// Uses the indices at the sodium line for all wavelengths.
Material without_dispersion(const Material& material);
Material with_absorption_times(const Material& material, double factor);

/// The catalogue's materials nearest in mean index at the sodium line (different by at least
/// 0.002), nearest first. They keep this material's absorption, so that only the index is tested.
std::vector<Material> neighbouring_materials(const Material& material, int count);

}  // namespace culet
