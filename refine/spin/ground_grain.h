#pragma once
// What a picture shows of a turntable's ground.

#include <glm/vec2.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "compare/turntable/edge_points.h"
#include "fit/silhouettes/turning_camera.h"

namespace culet {

/// Grain: brightness without light, shadow and noise, in levels, limited so that a hair counts no
/// more than dust. NaN at the stone and beside it.
cv::Mat ground_grain(const LevelPicture& picture, const std::vector<glm::dvec2>& stone);

/// Bilinear, at a place from the picture's middle, x to the right, y up; NaN beyond the picture.
double grain_at(const cv::Mat& grain, const glm::dvec2& place);

/// The ground, a plane `depth` below the frame's origin, in the picture.
class GroundView {
public:
    GroundView(const TurningCamera& camera, double turn, double depth)
        : axes_(picture_axes(camera, turn)), depth_(depth) {}
    glm::dvec2 in_picture(const glm::dvec2& on_ground) const;
    glm::dvec2 on_ground(const glm::dvec2& in_picture) const;

private:
    PictureAxes axes_;
    double depth_;
};

struct GroundLandmark {
    glm::dvec2 place{0, 0};  ///< on the ground, in the stone's frame
    double level = 0;
};

/// The turn, of those from `about` - `reach` to `about` + `reach`, at which a picture shows the
/// landmarks best.
struct GroundMatch {
    double turn = 0, correlation = -1;
};
GroundMatch best_match(const std::vector<GroundLandmark>& landmarks, const cv::Mat& grain,
                       const TurningCamera& camera, double depth, double about, double reach,
                       double step);

}  // namespace culet
