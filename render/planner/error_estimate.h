#pragma once
// How far a finished picture is from the truth, and how sure that is: the reference with everything
// on at a few of its pixels, and at more as long as these leave it open.
//
// The error of a picture p is the mean over the stone's pixels of |p - t| over the mean of t. A
// true pixel t is drawn with few rays, which are off by some e of mean 0, whatever p: then
// |p - t - e| is no smaller in the mean than |p - t| (Jensen's inequality). So the mean over pixels
// chosen by chance with three of its standard errors is a bound, and the more is allowed the fewer
// pixels and rays it takes. Pixels beside which the picture changes, and those where a bright light
// may be seen at another wavelength (light_edge_scan.h), are chosen more often, and count less
// (Hansen & Hurwitz 1943): that is where pictures are off. Few pixels are off by much, so that the
// mean of some is not distributed normally: what their skewness adds to the limit is in the bound
// (Johnson 1978, JASA 73, eq. 2.4). Where lights are bright, pixels that have more of the picture's
// light than a small share are all looked at, and the chosen ones tell of the others: what a
// picture shows where it is not there is not left to chance.
//
// One picture is looked at `k_looks` times at most, with a bound each.

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "render/beams/frame_renderer.h"
#include "render/image/picture.h"
#include "render/optics/path.h"
#include "render/planner/check_pixels.h"
#include "render/planner/pilot_picture.h"
#include "render/work/price.h"

namespace culet {

struct ErrorEstimate {
    int pixels = 0, samples = 0;
    double difference = 0;  ///< mean over them, with the noise of the truth's rays
    double spread = 0;      ///< its standard error
    double skewness = 0;    ///< what few pixels that are off by much add to three of these
    double noise = 0;       ///< about what the truth's few rays are off by
    double bound = 0, bound_delta_e = 0;

    /// The difference less the noise, as of independent quantities.
    double error() const;
    /// The same, as far as it can be seen: noise that is all that is seen hides it.
    double seen() const { return std::max(error(), 0.5 * difference); }
};

class ErrorEstimator {
public:
    static constexpr int k_looks = 5;

    /// `scene`: one window, with the effects that pictures are held against; `tolerance`: that is
    /// to be decided; `some`: pixels of the stone. Nothing is drawn yet. `progress` must outlive
    /// it.
    ErrorEstimator(const Scene& scene, StonePixels some, double tolerance,
                   const Progress& progress);

    /// What 16 rays of the truth are off by, as some pixels show it, which are drawn for it.
    double noise_of_16();
    int samples() const;
    /// Price (price.h) of one eye ray in one band, as what was drawn shows it.
    double band_ns() const;

    /// Looks at more and more pixels, or with more rays, until the bound fits into `room`, or the
    /// picture is certainly too far off, or the next step would be worth more than `most_ns`.
    /// `frames`: that drew it, if any (light_edge_scan.h).
    ErrorEstimate estimate(const Picture& picture, double room, double most_ns,
                           FrameRenderer* frames = nullptr);

    /// What effects that a picture leaves out change at the first `pixels` of the last estimate, by
    /// the truth's own rays, beyond their noise.
    double without_effects(const std::array<bool, k_effect_count>& effects, int pixels);
    /// Another picture has more to tell of where to look: pixels are chosen anew, and drawn.
    void look_elsewhere();
    /// A light is so bright that its image in a few pixels counts. After `estimate`.
    bool sees_sun() const { return chosen_.sun; }

private:
    // Rays of one grid in each of the first pixels, and in the outliers of some picture.
    struct Level {
        int samples = 0;
        std::vector<Rgb> rgb, outliers;
        double halves = 0, radiance = 0, cut = 0;  // sums over the first, as they count
    };
    int grid(std::size_t level) const;
    void choose(const Picture& picture, FrameRenderer* frames);
    PilotDrawing draw(const StonePixels& pixels, int samples);
    void take_more();
    void draw_up_to(std::size_t count);
    Rgb truth(std::vector<Rgb> Level::*of, std::size_t pixel) const;
    void find_outliers(const Picture& picture);
    double noise_of(const Level& level) const;
    ErrorEstimate look(const Picture& picture, std::size_t wanted);

    Scene scene_;
    StonePixels some_;
    PathLimits limits_;
    int nodes_;
    const Progress* progress_;
    CheckPixels chosen_;
    StonePixels outliers_;                                   // of all pictures so far
    std::map<std::pair<int, int>, std::size_t> of_picture_;  // the picture's, and which of those
    std::vector<Level> levels_;
    PathWork work_;
    double rays_drawn_ = 0;              // pixels x samples
    std::optional<double> noise_of_16_;  // once it was drawn
};

/// Of one finished picture of a scene, held against the truth at the scene's tolerance. Without
/// pixels on the stone: 0 of them, and a bound of NaN.
ErrorEstimate estimate_error(const Scene& scene, const Picture& picture, const Progress& progress);

}  // namespace culet
