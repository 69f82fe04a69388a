#pragma once
// The uncertainty of a picture that follows from that of the stone's facets.

#include <array>
#include <cstddef>
#include <vector>

#include "render/engine/scene_plan.h"
#include "render/image/picture.h"
#include "render/scene/scene.h"
#include "render/uncertainty/drawn_stones.h"
#include "stone/progress/progress.h"

namespace culet {

/// Statistics of every pixel over pictures of drawn stones: the mean, and the standard deviation of
/// one picture (not of the mean). Linear light, as in Picture.
struct PictureUncertainty {
    std::vector<float> mean, sigma;      ///< R, G, B: three per pixel
    std::vector<float> sigma_luminance;  ///< one per pixel; not the sum of those of R, G and B
    /// Luminance quantiles, four per pixel: the true stone lies below them with the probabilities
    /// k_band_levels. Reflexes come and go with a facet's angle, so pixels are not normally
    /// distributed, and mean and sigma do not give these probabilities.
    std::vector<float> bands;
    int draws = 0;
    int left_out = 0;  ///< draws that bound no stone
    bool correlated = false;
};

/// Probabilities of a normal distribution at two and one standard deviations below and above its
/// mean.
inline constexpr std::array<double, 4> k_band_levels{0.02275, 0.15866, 0.84134, 0.97725};

/// Draws `draws` (at least 2) stones by beams, with the settings that `plan` has for the stone
/// itself. A standard deviation from n draws has a relative error of 1/sqrt(2 (n - 1)) for normally
/// distributed pixels: 7 % for 100. Throws InputError if beams cannot draw the scene, the stone is
/// not convex, or fewer than two draws bound a stone; and Interrupted.
PictureUncertainty picture_uncertainty(const Scene& scene, const ScenePlan& plan,
                                       const StoneUncertainty& uncertainty, int draws,
                                       const Progress& progress = {});

/// Largest product of pixels and draws: 2 GB.
inline constexpr std::size_t k_most_kept = 500'000'000;

/// Adds the channels `mean.R`, `mean.G`, `mean.B`, `sigma.R`, `sigma.G`, `sigma.B`, `sigma.Y` and
/// the quantiles `p02.Y`, `p16.Y`, `p84.Y`, `p98.Y`.
void add_layers(const PictureUncertainty& uncertainty, Picture& picture);

}  // namespace culet
