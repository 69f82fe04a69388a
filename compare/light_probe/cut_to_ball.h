#pragma once
// Cuts a photograph to the ball, at the resolution that a map can hold.

#include <memory>

#include "compare/light_probe/light_probe.h"

namespace culet {

/// `prior` is in pixels of the cut picture.
struct CutToBall {
    std::string name;  ///< the photograph's, for messages
    std::shared_ptr<const Photo> picture;
    ViewPrior prior;
    double left = 0, top = 0, factor = 1;  ///< of the cut in the photograph

    PixelPlace in_photograph(const PixelPlace& p) const {
        return {(p.x + 0.5) * factor - 0.5 + left, (p.y + 0.5) * factor - 0.5 + top};
    }
    BallCircle in_photograph(const BallCircle& c) const {
        const PixelPlace middle = in_photograph(PixelPlace{c.x, c.y});
        return {middle.x, middle.y, c.radius * factor};
    }
    PixelPlace in_cut(const PixelPlace& p) const {
        return {(p.x - left + 0.5) / factor - 0.5, (p.y - top + 0.5) / factor - 0.5};
    }
};

/// For a lat-long map of `width` texels. `sigma_px`: the circle's, in the photograph.
CutToBall cut_to_ball(const ProbeView& view, const BallCircle& circle, double sigma_px,
                      const ProbeOptions& options, int width);

}  // namespace culet
