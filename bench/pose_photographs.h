#pragma once
// Simulated photographs for registration: as they are taken (blurred, noisy, compressed, cropped),
// of stones that their model knows to some tenths of a degree; and such as must be refused.

#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "compare/pose/stone_view.h"
#include "stone/solid/solid.h"

namespace culet {

struct PhotographSettings {
    int size = 400, threads = 0;
    /// Pixels that the stone is across, at random; 0: as `size` has it.
    double least_stone_px = 0, most_stone_px = 0;
    double facet_deg = 0.2;       ///< of the model, one sigma
    double off_standard_deg = 0;  ///< of every other stone, from the standard cut
    double start_deg = 30, start_scale = 0.2, tilt_deg = 30;
    double least_blur = 0.7, most_blur = 0.7;  ///< pixels
    double full_well = 12000;
    int jpeg_quality = 0;
    bool crop = false;
    std::string cut, light;  ///< empty: in turn
};

/// What is wrong with a photograph and its model: nothing; a model of another cut, or of other
/// proportions; a photograph of the other side, or turned left to right; a start that is turned to
/// the next place where the cut looks alike; a picture without that stone.
enum class Fault { none, other_cut, other_angles, other_side, mirrored, turned_start, no_stone };
const std::vector<std::pair<std::string, Fault>>& faults();

struct PosePhotograph {
    Photo photo;
    std::vector<float> coverage;  ///< of the stone, a share a pixel; empty when cropped
    Solid model;
    StoneView truth;
    Camera start;
    int fold = 1;  ///< turns about z that leave the model as it is
    std::string label;
};

PosePhotograph pose_photograph(const PhotographSettings& settings, int seed,
                               Fault fault = Fault::none);

/// From the truth to what was found, by the least turn of those that differ by the model's
/// symmetry.
Vec3 turn_between(const StoneView& truth, const StoneView& found, int fold);

}  // namespace culet
