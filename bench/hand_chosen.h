#pragma once
// Settings that a patient person could have found: a sweep over engines, cuts, wavelengths, rays
// and effects, each timed and held against the truth.

#include <string>
#include <vector>

#include "render/planner/truth.h"
#include "render/scene/scene.h"

namespace culet {

struct HandChosen {
    std::string words;
    double cpu = 0;    ///< seconds of one drawing, all threads; beams without their check
    double error = 0;  ///< as `Verification::measured`
};

/// Beams draw the whole picture; of the reference, whose time is that of its pixels, only those of
/// the truth are drawn, and their time is scaled up. `finest`: no tolerance below it is asked for.
std::vector<HandChosen> hand_chosen(const Scene& scene, const Truth& truth, double finest);

/// The quickest of those within the tolerance; nullptr: none is.
const HandChosen* cheapest_within(const std::vector<HandChosen>& settings, double tolerance);

/// The picture's pixels at those of a truth, drawn by the reference as `scene` says.
struct ReferenceSample {
    Verification found;
    double cpu = 0;  ///< of the whole picture
    double halves_apart = 0;
};
ReferenceSample sample_reference(const Scene& scene, const Truth& truth);

}  // namespace culet
