#pragma once
// Edges of a stone's surface inside its outline, by how they move from frame to frame.
//
// A straight edge across a known direction has two unknowns: its distance from the stone's axis and
// its height. At the right ones it lies on an edge of the picture in nearly every frame, bright or
// dark; what is seen through the stone moves otherwise and is spread over the sweep.

#include <opencv2/core.hpp>
#include <vector>

#include "refine/spin/stone_attitude.h"
#include "refine/spin/surface_edge.h"

namespace culet {

/// A frame's slopes, in levels a pixel, and how the upright stone falls on it.
struct SweptFrame {
    cv::Mat along_x, along_y;
    Projection projection{};
};
/// Without a projection.
SweptFrame swept_frame(const LevelPicture& picture);

/// One side of the upright stone: edges across `azimuth`, seen over `half_length` on both sides of
/// `middle`, which counts counter-clockwise. Lengths in pixels.
struct SweptSide {
    double azimuth = 0, middle = 0, half_length = 0;
    double least_radius = 0, most_radius = 0, least_height = 0, most_height = 0;
};

/// The strongest first.
std::vector<SurfaceEdge> surface_edges(const std::vector<SweptFrame>& frames,
                                       const SweptSide& side);

/// The same edge where other frames show it best, within 2 pixels.
SurfaceEdge found_again(const std::vector<SweptFrame>& frames, const SweptSide& side,
                        const SurfaceEdge& edge);

}  // namespace culet
