#pragma once
// The truth at a few pixels of a finished picture, and the picture's error there.

#include "render/engine/render_result.h"
#include "render/planner/pilot_picture.h"

namespace culet {

struct Truth {
    StonePixels pixels;
    PilotDrawing drawing;
    int samples = 0;
};
/// Draws with the reference and every effect that can matter, with negligible cut-off weights, at
/// 29 or more wavelengths, and with `samples` rays per pixel.
Truth draw_truth(const Scene& scene, const ScenePlan& plan, int pixels, int samples,
                 const Progress& progress = {});
Truth draw_truth(const Scene& scene, const ScenePlan& plan, StonePixels pixels, int samples,
                 const Progress& progress = {});

/// Compares `picture` at those pixels. The noise of the truth's own rays is subtracted in
/// quadrature: measured^2 = difference^2 - noise^2.
Verification compare_with_truth(const Truth& truth, const Picture& picture);

}  // namespace culet
