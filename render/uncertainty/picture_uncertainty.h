#pragma once
// What the uncertainty of a stone's facets makes of its picture.

#include <array>
#include <cstddef>
#include <vector>

#include "render/engine/scene_plan.h"
#include "render/image/picture.h"
#include "render/scene/scene.h"
#include "render/uncertainty/drawn_stones.h"
#include "stone/progress/progress.h"

namespace culet {

/// Of every pixel, over pictures of drawn stones: mean, and standard deviation of one picture from
/// it (not of the mean). Linear light, as in Picture.
struct PictureUncertainty {
    std::vector<float> mean, sigma;      ///< R, G, B: three a pixel
    std::vector<float> sigma_luminance;  ///< one a pixel: not the sum of those of R, G and B
    /// Of the luminance, four a pixel: below them lies the true stone with the probabilities of
    /// k_band_levels. Reflexes come and go with a facet's angle, so that pixels are not distributed
    /// normally, and mean and sigma do not tell how often the truth is within.
    std::vector<float> bands;
    int draws = 0;
    int left_out = 0;  ///< draws that were no stone
    bool correlated = false;
};

/// A normal distribution's two and one standard deviations below its mean, and above.
inline constexpr std::array<double, 4> k_band_levels{0.02275, 0.15866, 0.84134, 0.97725};

/// Stones drawn `draws` (at least 2) times, each drawn by the beams with `plan`'s settings: what
/// was chosen for the picture of the stone itself. A standard deviation of n draws is itself known
/// to 1/sqrt(2 (n - 1)) where pixels are distributed normally: 7 % of 100. Throws InputError where
/// the beams cannot draw the scene, the stone is not convex, or fewer than two draws are stones;
/// and Interrupted.
PictureUncertainty picture_uncertainty(const Scene& scene, const ScenePlan& plan,
                                       const StoneUncertainty& uncertainty, int draws,
                                       const Progress& progress = {});

/// Pixels times draws: 2 GB.
inline constexpr std::size_t k_most_kept = 500'000'000;

/// The picture's channels `mean.R`, `mean.G`, `mean.B`, `sigma.R`, `sigma.G`, `sigma.B`, `sigma.Y`,
/// and the bands `p02.Y`, `p16.Y`, `p84.Y`, `p98.Y`.
void add_layers(const PictureUncertainty& uncertainty, Picture& picture);

}  // namespace culet
