#pragma once
// What of a scene's optics other renderers have: one index of a stone, its absorption in RGB.

#include <string>
#include <vector>

#include "render/export/scene_parts.h"
#include "render/setup/optical_setup.h"
#include "render/shaded/plain_surface.h"

namespace culet {

struct StoneOptics {
    double index_nm = k_d_line_nm;  ///< the sodium line, or the scene's one wavelength
    double index = 1.5;             ///< there; of crystals the mean
    bool disperses = false;         ///< and the scene calls for it; likewise
    bool birefringent = false, pleochroic = false;
    Rgb absorption{};  ///< Napierian, per stone's unit; 0: none, or the scene has none
};

/// By the stone's own material: the first of a scene decides nothing about the others. Notes say
/// what is left out: double refraction, pleochroism, the spectrum of absorption.
StoneOptics optics_of(const Stone& stone, const Scene& scene, std::vector<std::string>& notes);

/// Where an ideal conductor's k is infinite, the largest that reflects less than all: 0.9999.
MetalIndex finite_index_of(const MetalMaterial& metal);

/// Notes on polarisation by the faces and on the lens, where the scene calls for them.
void note_left_out(const Scene& scene, std::vector<std::string>& notes);

/// Notes on what a map of the distant lights loses; a texel is `degrees` wide.
void note_light_map(const DistantLights& lights, double degrees, std::vector<std::string>& notes);

}  // namespace culet
