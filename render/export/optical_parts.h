#pragma once
// The optics that other renderers support: one index per stone, and absorption in RGB.

#include <string>
#include <vector>

#include "render/export/scene_parts.h"
#include "render/setup/optical_setup.h"
#include "render/shaded/plain_surface.h"

namespace culet {

struct StoneOptics {
    double index_nm = k_d_line_nm;  ///< the sodium line, or the scene's only wavelength
    double index = 1.5;             ///< at index_nm; for crystals the mean
    bool disperses = false;         ///< and the effect is on in the scene
    bool birefringent = false, pleochroic = false;
    Rgb absorption{};  ///< Napierian, per stone's unit; 0: none, or off in the scene
};

/// For any stone of the scene. Notes what is left out: birefringence, pleochroism, the spectrum of
/// absorption.
StoneOptics optics_of(const Stone& stone, const Scene& scene, std::vector<std::string>& notes);

/// Replaces the infinite k of an ideal conductor by that of a reflectance of 0.9999.
MetalIndex finite_index_of(const MetalMaterial& metal);

/// Notes that polarisation by faces and the lens are left out, if the scene uses them.
void note_left_out(const Scene& scene, std::vector<std::string>& notes);

/// Notes the losses in a map of distant lights; a texel is `degrees` wide.
void note_light_map(const DistantLights& lights, double degrees, std::vector<std::string>& notes);

}  // namespace culet
