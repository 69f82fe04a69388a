#pragma once
// Estimates the error of a finished picture. The truth is the reference with everything on, drawn
// at a few pixels, and at more until they decide.
//
// The error of a picture p is the mean of |p-t| over the stone's pixels, over the mean of t. A true
// pixel t has few rays, whose error e has mean 0 independently of p; so the mean of |p-t-e| is not
// below that of |p-t| (Jensen's inequality), and the mean over random pixels plus three standard
// errors is a bound. The larger the tolerance, the fewer pixels and rays it takes.
//
// Errors concentrate where the picture changes and where a bright light may be seen at another
// wavelength (light_edge_scan.h): such pixels are chosen more often and weigh less (Hansen &
// Hurwitz 1943). As large errors are rare, means are not normally distributed; the bound includes a
// skewness correction (Johnson 1978, JASA 73, eq. 2.4). With bright lights, all pixels with more
// than a small share of the picture's light are checked and the random ones stand for the others,
// so that wrongly placed light is always found.
//
// Each picture is looked at up to `k_looks` times.

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
    double difference = 0;      ///< mean over the pixels, including noise of the truth's rays
    double standard_error = 0;  ///< its standard error
    double skewness = 0;        ///< skewness correction to three standard errors
    double noise = 0;           ///< estimated error of the truth's few rays
    double bound = 0, bound_delta_e = 0;

    /// Difference less noise, subtracted in quadrature.
    double error() const;
    /// error(), but at least half the difference: strong noise hides the error.
    double seen() const { return std::max(error(), 0.5 * difference); }
};

class ErrorEstimator {
public:
    static constexpr int k_looks = 5;

    /// Draws nothing yet. `scene`: one window, with the effects of the truth. `tolerance`: to be
    /// decided on. `some`: pixels of the stone. `progress` must outlive it.
    ErrorEstimator(const Scene& scene, StonePixels some, double tolerance,
                   const Progress& progress);

    /// Error of 16 rays per pixel of the truth, estimated by drawing some pixels.
    double noise_of_16();
    int samples() const;
    /// Price (price.h) of one eye ray in one band, from what was drawn so far.
    double band_ns() const;

    /// Adds pixels or rays until the bound is below `room`, the picture is certainly too far off,
    /// or the next step would cost more than `most_ns`. `frames`: as in light_edge_scan.h.
    ErrorEstimate estimate(const Picture& picture, double room, double most_ns,
                           FrameRenderer* frames = nullptr);

    /// Change, beyond noise, if the truth omits the effects that a picture omits; at the first
    /// `pixels` of the last estimate.
    double without_effects(const std::array<bool, k_effect_count>& effects, int pixels);
    /// Forgets the chosen pixels: the next picture is a better guide to where to look.
    void forget_pixels();
    /// Whether a light is so bright that its image in a few pixels counts. Valid after `estimate`.
    bool sees_sun() const { return chosen_.sun; }

private:
    // The truth with one grid of rays: at the first pixels, and at all outliers so far.
    struct Level {
        int samples = 0;
        std::vector<Rgb> rgb, outliers;
        double halves = 0, radiance = 0, cut = 0;  // weighted sums over the first pixels
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
    std::map<std::pair<int, int>, std::size_t> of_picture_;  // outliers of the picture: index into
                                                             // outliers_
    std::vector<Level> levels_;
    PathWork work_;
    double rays_drawn_ = 0;              // pixels x samples
    std::optional<double> noise_of_16_;  // once it was drawn
};

/// Checks one finished picture at the scene's tolerance. Without pixels on the stone: `pixels` 0,
/// bound NaN.
ErrorEstimate estimate_error(const Scene& scene, const Picture& picture, const Progress& progress);

}  // namespace culet
