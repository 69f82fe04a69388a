#pragma once
// Development of linear pictures for viewing. Pictures for comparison with photographs do not use
// it.

#include <optional>
#include <string>
#include <vector>

#include "render/image/picture.h"

namespace culet {

enum class ToneMap {
    none,
    reinhard,  ///< L / (1 + L) (Reinhard et al. 2002, eq. 3)
    filmic,    ///< film curve with toe and shoulder (Narkowicz 2015, a fit to ACES)
    gamma2     ///< for displays of gamma 2 instead of sRGB: the file holds the square root of the
               ///< light
};
/// Names in scenes and `--tonemap`.
std::vector<std::string> tone_map_names();
std::optional<ToneMap> tone_map_named(const std::string& name);
std::string name_of(ToneMap map);

/// Of a pale ground, relative to a white tent.
constexpr double k_usual_ground = 1;

struct PngLook {
    double exposure = 1;  ///< factor on linear light, applied first
    /// Part of the stone's pixels that exposure_for_stone lets exceed white.
    double share_over_white = 0.02;
    ToneMap tone_map = ToneMap::none;
    /// Scattering in the eye around bright points (glare.h), in multiples of the mean eye's; 0:
    /// none.
    double glare = 0;
    double degrees_per_pixel = 0.05;  ///< of the observer's view, for glare
    /// Streaks around pixels brighter than white (sparkle.h): their energy relative to the light
    /// above white; 0: none.
    double sparkle = 0;
    bool alpha = false;  ///< write the stone's coverage, if known, as alpha
    /// Radiance of the pale ground that is drawn where the stone does not cover the picture; 0:
    /// none. Without `alpha` and with known coverage only.
    double ground = 0;
    /// Part of its light that reaches the ground at each pixel (ground_shadow.h); empty: all.
    std::vector<float> ground_lit;
};

/// Light times the exposure, limited to finite values; 0 for NaN and negative light.
float exposed(float light, double exposure);
/// 0 to 1; increases with the light for every map.
float tone_mapped(float light, ToneMap map);

/// Whether every value shown depends on its own light alone.
bool is_pointwise(const PngLook& look);
/// R, G and B in linear light, 0 to 1, after ground, exposure, glare, sparkle and tone map. NaN and
/// negative values become 0.
std::vector<float> as_shown(const Picture& picture, const PngLook& look);

}  // namespace culet
