#pragma once
// Draws a few pixels of a picture by the reference, with chosen effects left out.

#include <utility>
#include <vector>

#include "render/optics/path.h"
#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"
#include "stone/progress/progress.h"

namespace culet {

/// Pixels whose middle the stone covers. They are spread evenly over the stone, and so is every
/// range of them.
struct StonePixels {
    std::vector<std::pair<int, int>> at;  ///< x, y
    double in_picture = 0;                ///< estimated number of stone pixels

    /// At most `count` pixels from `first` on.
    StonePixels range(std::size_t first, std::size_t count) const;
};
/// Returns about `wanted` pixels, or fewer if the stone has fewer; none if the stone was not found.
StonePixels stone_pixels(const Scene& scene, int wanted);
/// Returns all of them.
StonePixels all_stone_pixels(const Scene& scene);

struct PilotDrawing {
    std::vector<Rgb> rgb;  ///< of each pixel, behind the eye's optics
    std::vector<double> wavelengths_nm;
    double mean = 0;    ///< of R, G and B
    double rays = 0;    ///< eye rays x bands
    double events = 0;  ///< faces that light met
    /// Radiance at each wavelength, pixel by pixel: spectra[pixel * wavelengths + i].
    std::vector<double> spectra;
    double remainder = 0;  ///< mean weight left at the depth limit
    double cut = 0;        ///< mean weight of paths cut for their small weight
    double absorbed = 0;
    std::vector<double> halves_apart;  ///< per pixel (pixel_shader.h)
    double few_rays = 0;  ///< estimated error of the pixels due to their few rays, over the mean
    double brightest = 0;
    double surroundings_ns = 0;  ///< price of the objects around the stone (price.h)
    double seconds = 0;          ///< summed over threads
};

/// Ratio of half the difference between every other ray of a grid and the rest to the error of all
/// rays: 2^(3/4) / 2^(1/2), as the error of a grid falls as N^-3/4.
constexpr double k_halves_over_noise = 1.19;

/// Draws with the scene's settings, but with the depth and cut-off of `limits`. `nodes`: number of
/// wavelengths if a spectrum is needed and the scene names none. `progress` receives 0 and may stop
/// it: Interrupted.
PilotDrawing draw_pilot(const Scene& scene, const StonePixels& pixels, const PathLimits& limits,
                        int samples, int nodes = k_node_counts[1], const Progress& progress = {});

}  // namespace culet
