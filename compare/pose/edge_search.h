#pragma once
// Finds the photograph's edges along the normals of a predicted wireframe.

#include <opencv2/core/mat.hpp>
#include <vector>

#include "compare/pose/wireframe.h"

namespace culet {

/// A photograph prepared for that search.
struct EdgePicture {
    /// `colour`: CV_32FC3, linear; `saturation` as in Photo.
    EdgePicture(const cv::Mat& colour, double saturation);
    cv::Mat linear;         ///< CV_32FC3, slightly smoothed
    cv::Mat encoded;        ///< the same through the sRGB curve, where noise is nearly uniform
    cv::Mat clipped;        ///< CV_8U, 255 where the camera clipped; empty: nowhere
    double least_step = 0;  ///< least contrast of an edge, encoded
};

struct FoundEdge {
    double offset = 0;    ///< along the point's normal, pixels
    double contrast = 0;  ///< encoded
    double sigma = 0;     ///< of the offset, pixels
};

/// All edges within `reach` pixels, sorted by offset. An edge is where linear light is steepest, a
/// place that a lens's blur does not move.
std::vector<FoundEdge> edges_across(const EdgePicture& picture, const WirePoint& point,
                                    double reach);

}  // namespace culet
