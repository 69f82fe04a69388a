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

/// Below this tolerance pictures and the truth take more wavelengths and follow larger trees.
constexpr double k_fine_tolerance = 0.02;
/// Trees that branch play roulette below this weight, and above the other follow both branches: the
/// quickest way to little noise is to follow few branches where few rays do.
constexpr double tree_cut(double tolerance) {
    return tolerance < k_fine_tolerance ? 0.01 : 0.04;
}
constexpr double tree_split(double tolerance) {
    return tolerance < k_fine_tolerance ? 0.3 : 0.6;
}

/// Pixels of a check, as the truth's fewest rays show them.
struct CheckedSample {
    StonePixels pixels;
    std::vector<double> counts;  ///< of each, 1 in the mean
    std::vector<Rgb> truth;
    PathLimits limits;
    int rays = 0, nodes = 0;  ///< a pixel; wavelengths
    double noise = 0;         ///< about what these rays are off by
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
    /// With about twice as many; what was drawn counts.
    void take_more();
    int samples() const;
    /// Price of taking more (price.h), at the pixels that were drawn.
    double more_ns() const;
    /// Price of a pixel with these (price.h), as what was drawn shows it.
    double pixel_ns() const;
    /// Wavelengths that an eye ray of the fewest carries, where each has its own way.
    double bands_of_a_ray() const;

    /// Looks at more and more pixels, or with more rays, until the bound fits into `room`, or the
    /// picture is certainly too far off, or the next step would be worth more than `most_ns`.
    /// `frames`: that drew it, if any (light_edge_scan.h).
    ErrorEstimate estimate(const Picture& picture, double room, double most_ns,
                           FrameRenderer* frames = nullptr);

    /// The truth at the first `pixels` of the last estimate, and how it was drawn.
    CheckedSample sample(std::size_t pixels) const;
    const Scene& scene() const { return scene_; }
    /// Another picture has more to tell of where to look: pixels are chosen anew, and drawn.
    void look_elsewhere();
    /// A light is so bright that its image in a few pixels counts. After `estimate`.
    bool sees_sun() const { return chosen_.sun; }

    /// A picture must not have this square of rays in its pixels: the truth has such a grid.
    static bool takes_grid(int side);

private:
    // Rays of one grid in each of the first pixels, and in the outliers of some picture.
    struct Level {
        int samples = 0;
        std::vector<Rgb> rgb, outliers;
        double halves = 0, radiance = 0, cut = 0;  // sums over the first, as they count
    };
    int grid(std::size_t level) const;
    double drawn_noise_of_16();
    void choose(const Picture& picture, FrameRenderer* frames);
    PilotDrawing draw(const StonePixels& pixels, int samples);
    void draw_up_to(std::size_t count);
    Rgb truth(std::vector<Rgb> Level::*of, std::size_t pixel) const;
    void find_outliers(const Picture& picture);
    double noise_of(const Level& level) const;
    ErrorEstimate look(const Picture& picture, std::size_t wanted);
    // How many pixels and grids, and how many rays that draws.
    struct Look {
        std::size_t pixels = 0, levels = 0;
        double rays = 0;
    };
    double rays_for(std::size_t pixels, std::size_t levels) const;
    std::optional<Look> next_look(const ErrorEstimate& estimate, double room,
                                  double standard_errors) const;

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
