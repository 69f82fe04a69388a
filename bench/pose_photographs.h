#pragma once
// Simulated photographs for testing registration: blurred, noisy, compressed, cropped, of stones
// that their model knows to some tenths of a degree; and photographs that must be refused.

#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "compare/pose/stone_view.h"
#include "stone/solid/solid.h"

namespace culet {

struct PhotographSettings {
    int size = 400, threads = 0;
    /// The stone's size is random in this range, pixels; 0: it follows from `size`.
    double least_stone_px = 0, most_stone_px = 0;
    double facet_deg = 0.2;       ///< the model's error, one sigma
    double off_standard_deg = 0;  ///< deviation of every other stone from the standard cut
    double start_deg = 30, start_scale = 0.2, tilt_deg = 30;
    double least_blur = 0.7, most_blur = 0.7;  ///< pixels
    double full_well = 12000;
    int jpeg_quality = 0;
    bool crop = false;
    std::string cut, light;  ///< empty: each in turn
};

/// In order: nothing; a model of another cut, or of other proportions; a photograph of the other
/// side, or mirrored; a start turned to the next position in which the cut looks alike; a picture
/// without the stone.
enum class Fault { none, other_cut, other_angles, other_side, mirrored, turned_start, no_stone };
const std::vector<std::pair<std::string, Fault>>& faults();

struct PosePhotograph {
    Photo photo;
    std::vector<float> coverage;  ///< the stone's share of each pixel; empty when cropped
    Solid model;
    StoneView truth;
    Camera start;
    int symmetry_order = 1;  ///< order of the model's symmetry about z
    std::string label;
};

PosePhotograph pose_photograph(const PhotographSettings& settings, int seed,
                               Fault fault = Fault::none);

/// Takes the smallest over the turns of the model's symmetry.
Vec3 turn_between(const StoneView& truth, const StoneView& found, int symmetry_order);

}  // namespace culet
