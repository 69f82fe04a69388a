#pragma once
// The truth at a few pixels of a finished picture, and how far the picture is from it.

#include "render/engine/render_result.h"
#include "render/planner/pilot_picture.h"

namespace culet {

/// Everything on, at a few pixels.
struct Truth {
    StonePixels pixels;
    PilotDrawing drawing;
    int samples = 0;
};
/// Drawn by the reference with every effect that can matter, down to weights that change nothing,
/// at twice the wavelengths of `plan` or more, with `samples` rays a pixel.
Truth draw_truth(const Scene& scene, const ScenePlan& plan, int pixels, int samples,
                 const Progress& progress = {});
Truth draw_truth(const Scene& scene, const ScenePlan& plan, StonePixels pixels, int samples,
                 const Progress& progress = {});

/// `picture` at those pixels. What the truth's own few rays are off by is taken off the error as of
/// independent quantities: measured^2 = difference^2 - noise^2.
Verification hold_against(const Truth& truth, const Picture& picture);

}  // namespace culet
