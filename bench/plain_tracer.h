#pragma once
// A ray tracer without beams, as fast as ordinary means make it, for comparison with the beams.
//
// It traces packets of neighbouring samples, as wide as the processor's vectors, in single
// precision: one wavelength, no absorption, a constant light and lobes. The first facet and each
// exit are first looked for where the packet before had them. Light as in light_paths.h.

#include <memory>

#include "render/image/picture.h"
#include "render/scene/scene.h"

namespace culet {

enum class ExitSearch {
    walk,        ///< all rays of a packet together, from facet to neighbouring facet
    every_plane  ///< test all planes for the nearest
};

struct PlainTracing {
    int across = 1;  ///< across^2 samples per pixel, on a grid
    bool polarised = false;
    ExitSearch search = ExitSearch::walk;
};

class PlainTracer {
public:
    /// Uses the scene's stone, camera (a pinhole), lights, depth and first wavelength. Throws
    /// InputError for scenes that it cannot draw.
    explicit PlainTracer(const Scene& scene);
    ~PlainTracer();

    /// Draws on the calling thread only, with the same rays as the reference with `across`^2
    /// samples.
    void draw(const PlainTracing& how, Picture& picture) const;

    struct Prepared;

private:
    std::unique_ptr<Prepared> prepared_;
};

}  // namespace culet
