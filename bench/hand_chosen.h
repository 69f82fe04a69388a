#pragma once
// Settings that a patient person could have found: a sweep over engines, cuts, wavelengths, rays
// and effects, timed and compared with the truth.

#include <string>
#include <vector>

#include "render/planner/truth.h"
#include "render/scene/scene.h"

namespace culet {

struct HandChosen {
    std::string words;
    double cpu = 0;    ///< seconds of one drawing, sum of all threads; beams without their check
    double error = 0;  ///< as `Verification::measured`
};

/// Beams draw the whole picture. The reference draws only the truth's pixels, and its time is
/// scaled up. `finest` is the smallest tolerance needed.
std::vector<HandChosen> hand_chosen(const Scene& scene, const Truth& truth, double finest);

/// The quickest of those within the tolerance; nullptr if there is none.
const HandChosen* cheapest_within(const std::vector<HandChosen>& settings, double tolerance);

/// The reference's picture, as `scene` says, at the pixels of a truth.
struct ReferenceSample {
    Verification found;
    double cpu = 0;  ///< of the whole picture
    double halves_apart = 0;
};
ReferenceSample sample_reference(const Scene& scene, const Truth& truth);

}  // namespace culet
