#pragma once
// The effects and wavelengths that a scene needs, and the error of leaving an effect out.

#include <array>
#include <string>
#include <vector>

#include "render/colour/colour.h"
#include "render/optics/band.h"
#include "render/scene/scene.h"
#include "render/work/price.h"

namespace culet {

struct EffectDecision {
    Effects effect = Effects::dispersion;
    bool on = false;
    std::string why;
    /// Bound on the radiance's error from leaving it out, relative to the brightest light; 0 if it
    /// is on or changes nothing; NaN (written as null) if no bound is known.
    double error_bound = 0;
};

struct OpticalSetup {
    std::array<EffectDecision, k_effect_count> effects;
    std::vector<double> wavelengths_nm;
    /// Per wavelength, if few wavelengths with fitted absorption (`bands`) stand for a coloured
    /// stone's spectrum (few_wavelengths.h); else empty.
    std::vector<Rgb> rgb_weight;
    std::vector<Band> bands;
    bool polarised = true;
    bool stokes = false;   ///< all four Stokes parameters are needed: polarised lights, an analyser
    bool general = false;  ///< needs crystal_paths.h; else light_paths.h suffices
    bool splits = false;   ///< the stone has two waves, so trees of paths double
    int open_edges = 0;    ///< of a non-convex stone

    bool on(Effects effect) const { return effects[static_cast<std::size_t>(effect)].on; }
    WavelengthSet colours() const {
        return rgb_weight.empty() ? WavelengthSet(wavelengths_nm)
                                  : WavelengthSet(wavelengths_nm, rgb_weight);
    }
};

/// Numbers of wavelengths to choose from, coarse to fine; each set contains the one before.
constexpr std::array<int, 4> k_node_counts{8, 15, 29, 57};

/// `nodes`: wavelengths if a spectrum is needed and the scene gives none. Throws InputError for
/// frosted facets in a stone or light for which they cannot be drawn.
OpticalSetup make_optical_setup(const Scene& scene, int nodes = k_node_counts[1]);

/// Work along a ray of one band, without its counts.
PathWork work_along_paths(const OpticalSetup& setup);

/// True if the wavelengths are the plan's choice of a spectrum.
bool chose_spectrum(const Scene& scene, const OpticalSetup& setup);

/// True if a ray's paths form a tree with small branches chosen at random.
bool paths_branch(const Scene& scene, const OpticalSetup& setup);
bool paths_branch(const Scene& scene);

}  // namespace culet
