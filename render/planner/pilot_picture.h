#pragma once
// A few pixels of the very picture, drawn by the reference with this and that left out.

#include <utility>
#include <vector>

#include "render/optics/path.h"
#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"
#include "stone/progress/progress.h"

namespace culet {

/// Pixels whose middle the stone covers, evenly spread over it, and so is every stretch of them
/// from the first.
struct StonePixels {
    std::vector<std::pair<int, int>> at;  ///< x, y
    double in_picture = 0;                ///< estimate of how many there are

    /// Those from the `first` on, at most `count`.
    StonePixels stretch(std::size_t first, std::size_t count) const;
};
/// About `wanted`, fewer where there are not as many. Empty: the stone was not found.
StonePixels stone_pixels(const Scene& scene, int wanted);
/// Every one.
StonePixels all_stone_pixels(const Scene& scene);

struct PilotDrawing {
    std::vector<Rgb> rgb;  ///< of each pixel, behind the eye's optics
    std::vector<double> wavelengths_nm;
    double mean = 0;    ///< of R, G and B
    double rays = 0;    ///< eye rays x bands
    double events = 0;  ///< faces that light met
    /// Radiance at each wavelength, pixel by pixel: spectra[pixel * wavelengths + i].
    std::vector<double> spectra;
    double remainder = 0;  ///< at the depth limit, mean weight
    double cut = 0;        ///< for their small weight, likewise
    double absorbed = 0;
    std::vector<double> halves_apart;  ///< of each pixel (pixel_shader.h)
    double few_rays = 0;  ///< about what the pixels are off by for their few rays, over the mean
    double brightest = 0;
    double surroundings_ns = 0;  ///< what objects around the stone took, at the prices of price.h
    double seconds = 0;          ///< that it took, of all threads together
};

/// Half the difference between every other ray of a grid and the rest is so many times what all of
/// them are off by: 2^(3/4) / 2^(1/2), where that falls with the number of rays as N^-3/4.
constexpr double k_halves_over_noise = 1.19;

/// `nodes`: wavelengths where a spectrum is called for and the scene names none. `scene`: with the
/// settings to draw with; their depth and tolerance are left aside for `limits`. `progress` is told
/// 0, and may stop it: Interrupted.
PilotDrawing draw_pilot(const Scene& scene, const StonePixels& pixels, const PathLimits& limits,
                        int samples, int nodes = k_node_counts[1], const Progress& progress = {});

}  // namespace culet
