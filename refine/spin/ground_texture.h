#pragma once
// A turntable's camera and turns from what lies on it: dust and grain on the ground turn with the
// stone, and every frame shows them again.
//
// Places in pictures: pixels from the middle, x to the right, y up.

#include <glm/vec2.hpp>
#include <vector>

#include "refine/spin/ground_grain.h"

namespace culet {

struct GroundTexture {
    std::vector<GroundLandmark> landmarks;  ///< their levels are means over the frames
    TurningSeries series;
    double depth = 0;  ///< of the ground below the frame's origin
    /// Part of single frames' variance at the landmarks that their mean explains.
    double agreement = 0;

    /// Noise alone has 7 / frames, since the strongest of its means are taken.
    bool found() const { return agreement > 0.3 && series.turns.size() >= 40; }
};

/// `stones`: the stone's outline in each picture; the ground near it is left out. `start`: each
/// turn may be off by 1.5 degrees against the turn before it. The first turn stays. `deepest`: how
/// far the ground may lie below the frame's origin.
GroundTexture ground_texture(const std::vector<const LevelPicture*>& pictures,
                             const std::vector<std::vector<glm::dvec2>>& stones,
                             const TurningSeries& start, double deepest);

/// Of one more picture, within 1.5 degrees of `about`.
double turn_by_ground(const GroundTexture& ground, const LevelPicture& picture,
                      const std::vector<glm::dvec2>& stone, double about);

}  // namespace culet
