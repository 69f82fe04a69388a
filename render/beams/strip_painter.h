#pragma once
// Paints beams into pixels, one strip of rows at a time.

#include <functional>
#include <memory>
#include <vector>

#include "render/beams/beam_shading.h"
#include "render/beams/facet_sequence.h"
#include "render/beams/pixel_coverage.h"
#include "render/beams/sorted_beams.h"
#include "render/beams/split_beams.h"

namespace culet {

/// How the pixels of a beam are shaded.
enum class BeamShading {
    flat,     ///< one colour per beam, exact areas of pixels
    single,   ///< each pixel's middle, exactly and verified: no anti-aliasing
    averaged  ///< each touched pixel's middle along each beam's facets, times its area
};

/// Nodes of a band that follow one set of beams and are shaded together.
struct ShadingPass {
    std::size_t beams = 0;          ///< which set of the view
    double n = 1;                   ///< index relative to the outside
    std::size_t plane = 0;          ///< of the first node; one plane per node
    double weight = 1;              ///< of its sums in the report, per node
    bool counts_area = false;       ///< set in one pass only
    std::vector<double> luminance;  ///< per node, for the report
    ShadedOptics optics;
    ShadedLights lights;
    /// Crystals with split waves store no beams: these are grown while painting.
    struct SplitWaves {
        Band band;
        Stokes response{1, 0, 0, 0};
        bool polarised_lights = false;
    };
    std::shared_ptr<const SplitWaves> split;
};

/// Planes of pixels to which light is added, and the share of each pixel that the stone fills.
struct Canvas {
    int width = 0, height = 0;
    std::vector<float> planes;  ///< plane * pixels + pixel
    std::vector<float> coverage;

    std::size_t pixels() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

struct StripSums {
    double filled = 0, remainder = 0, absorbed = 0, luminance = 0;
    long long fragments = 0, retraced = 0, beams = 0;
    long long faces = 0;  ///< met by fragments; up to eight count once
    int deepest = 0;
    StripSums& operator+=(const StripSums& more);
};

struct PaintedStone {
    explicit PaintedStone(const Solid& convex) : net(convex), shaded(net), body(convex) {}
    FacetNet net;
    ShadedStone shaded;
    ConvexBody body;
};

struct PaintOptions {
    BeamShading shading = BeamShading::averaged;
    int depth = 8;  ///< as the beams' limits
    double cut_weight = 0;
    double share = 1;  ///< of the picture: one over the points of the pupil
    /// Asked now and then with the strip's sums so far; false: the rest is skipped.
    std::function<bool(const StripSums&)> goes_on = {};
};

/// Painter of one thread.
class StripPainter {
public:
    StripPainter(const PaintedStone& stone, Canvas& canvas) : stone_(stone), canvas_(canvas) {}

    /// Adds what `view` sees in strip number `strip`. `beams`: the view's sets. `fronts`: its front
    /// facets.
    StripSums paint(int strip, const ScreenView& view, const SortedBeams* beams,
                    const std::vector<FrontFacet>& fronts, const std::vector<ShadingPass>& passes,
                    const PaintOptions& options);

private:
    bool goes_on() const { return !options_.goes_on || options_.goes_on(sums_); }
    void paint_split(const std::vector<FrontFacet>& fronts, const ShadingPass& pass);
    void paint_leaving(const LeavingBeam& beam, const ScreenPoint* corners, std::size_t count,
                       const ShadingPass& pass);
    void paint_beam(const SortedBeams& beams, BeamNumber number, const ShadingPass& pass);
    void paint_flat(const CoveredPixels& covered, const Beam& beam, const std::uint16_t* facets,
                    const ShadedEye& eye, const ShadingPass& pass);
    Fragments fragments_of(const CoveredPixels& covered, const ShadingPass& pass);
    void add_light(const CoveredPixels& covered, const float* shares, const ShadingPass& pass,
                   bool before);
    void add_cover(const CoveredPixels& covered, const float* shares, const float* unhidden);
    void paint_pixels(const CoveredPixels& covered, const Beam& beam, int to_verify,
                      const std::uint16_t* facets, const ShadedEye& eye, const ShadingPass& pass);
    bool retrace(int pixel, const ShadingPass& pass, std::size_t longest, float* radiance,
                 int stride, float& left, float& absorbed, float& unhidden, float* before);
    void retrace_astray(const CoveredPixels& covered, int verified, const Beam& beam,
                        const ShadingPass& pass, const float* share);
    void fill_holes(const std::vector<FrontFacet>& fronts, const std::vector<ShadingPass>& passes);
    void add_background(const std::vector<ShadingPass>& passes);
    void reserve(int count, int nodes);
    PixelRows plane(const ShadingPass& pass, int node) {
        return {canvas_.planes.data() +
                    (pass.plane + static_cast<std::size_t>(node)) * canvas_.pixels(),
                0};
    }
    /// A plane that holds only this strip.
    PixelRows strip(std::vector<float>& values) {
        return {values.data(), row_begin_ * canvas_.width};
    }

    const PaintedStone& stone_;
    Canvas& canvas_;
    PixelCoverage coverage_;
    std::vector<float> unhidden_, before_, visible_, cover_, taken_, radiance_, left_, absorbed_,
        share_, verified_;
    std::vector<int> holes_;
    std::vector<std::uint16_t> facets_;
    // State of the strip being painted.
    const ScreenView* view_ = nullptr;
    PaintOptions options_;
    int row_begin_ = 0, row_end_ = 0;
    bool hides_ = false;  ///< there are near lights
    StripSums sums_;
};

}  // namespace culet
