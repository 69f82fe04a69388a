#pragma once
// How a picture in linear light becomes one that is looked at. Pictures that are compared with
// photographs have none of this.

#include <optional>
#include <string>
#include <vector>

#include "render/image/picture.h"

namespace culet {

enum class ToneMap {
    none,
    reinhard,  ///< L / (1 + L) (Reinhard et al. 2002, eq. 3)
    filmic,    ///< a film's curve with toe and shoulder (Narkowicz 2015, a fit to ACES)
    gamma2     ///< a display of gamma 2, for sRGB's: the file holds the square root of the light
};
/// As scenes and `--tonemap` have them.
std::vector<std::string> tone_map_names();
std::optional<ToneMap> tone_map_named(const std::string& name);
std::string name_of(ToneMap map);

struct PngLook {
    double exposure = 1;  ///< factor on linear light, before all else
    ToneMap tone_map = ToneMap::none;
    /// Light that the eye scatters about bright points (glare.h), as a multiple of what the mean
    /// eye does; 0: none.
    double glare = 0;
    double degrees_per_pixel = 0.05;  ///< of the observer's view; glare depends on it
    /// Streaks of what is brighter than white in two directions (sparkle.h): their energy over that
    /// of the bright light; 0: none.
    double sparkle = 0;
    bool alpha = false;  ///< the stone's coverage as the file's alpha, where it is known
};

/// Light times the exposure, within what numbers hold; 0 for what is no number or negative.
float exposed(float light, double exposure);
/// 0 to 1; grows with the light under every map.
float tone_mapped(float light, ToneMap map);

/// R, G and B of each pixel in linear light, 0 to 1: exposure, glare, sparkle, tone map. What is
/// no number or negative is 0.
std::vector<float> as_shown(const Picture& picture, const PngLook& look);

}  // namespace culet
