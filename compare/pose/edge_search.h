#pragma once
// Where, along the normals of a predicted wireframe, the photograph has edges.

#include <opencv2/core/mat.hpp>
#include <vector>

#include "compare/pose/wireframe.h"

namespace culet {

/// A photograph made ready for looking across edges.
struct EdgePicture {
    /// `colour`: CV_32FC3, linear; `saturation` as in Photo.
    EdgePicture(const cv::Mat& colour, double saturation);
    cv::Mat linear;         ///< CV_32FC3, smoothed a little
    cv::Mat encoded;        ///< the same through the sRGB curve: noise is about even there
    cv::Mat clipped;        ///< CV_8U, 255 where the camera clipped; empty: nowhere
    double least_step = 0;  ///< an edge's least contrast, encoded
};

struct FoundEdge {
    double offset = 0;    ///< along the point's normal, pixels
    double contrast = 0;  ///< encoded
    double sigma = 0;     ///< of the offset, pixels
};

/// All edges within `reach` pixels, by offset. An edge is where the picture in linear light is
/// steepest: a lens blurs light, not its encoding, so there it leaves the place unmoved.
std::vector<FoundEdge> edges_across(const EdgePicture& picture, const WirePoint& point,
                                    double reach);

}  // namespace culet
