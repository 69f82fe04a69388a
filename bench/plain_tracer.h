#pragma once
// A ray tracer without beams, as quick as plain means make it: what the beams are measured against.
//
// Packets of as many rays as the processor's vectors hold, of neighbouring samples, in single
// precision; one wavelength, no absorption; a constant light and lobes. The first facet and each
// exit are first looked for where the packet before had them. Light as in light_paths.h.

#include <memory>

#include "render/image/picture.h"
#include "render/scene/scene.h"

namespace culet {

enum class ExitSearch {
    walk,        ///< from facet to neighbouring facet, all rays of a packet together
    every_plane  ///< the nearest of all planes
};

struct PlainTracing {
    int across = 1;  ///< samples a pixel: across^2, on a grid
    bool polarised = false;
    ExitSearch search = ExitSearch::walk;
};

class PlainTracer {
public:
    /// Takes stone, camera (a pinhole), lights, depth and the first wavelength. Throws InputError
    /// for scenes that it cannot draw.
    explicit PlainTracer(const Scene& scene);
    ~PlainTracer();

    /// On the calling thread alone. The same rays as the reference's with `across`^2 samples.
    void draw(const PlainTracing& how, Picture& picture) const;

    struct Prepared;

private:
    std::unique_ptr<Prepared> prepared_;
};

}  // namespace culet
