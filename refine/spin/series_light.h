#pragma once
// The light in which a stone was photographed on a turntable, and how much the stone, rendered in
// it, looks like the frames left out.
//
// The light stands still before the camera while the stone turns, so each frame shows other parts
// of it in other places. Radiances of few zones (zone_shares.h), not negative, are those with which
// renders come nearest to the frames, by least squares over squares of a tenth of the stone's
// width, since reflexes of a stone that is known to a degree are off by about that. The difference
// counts in proportion to the brightness.

#include <array>
#include <string>
#include <vector>

#include "compare/scores/score.h"
#include "refine/spin/spin.h"
#include "stone/material/material.h"

namespace culet {

struct ZoneLight {
    std::string name;  ///< "high back": its elevation, and its side as the camera sees it
    /// Radians; the azimuth counter-clockwise from above, from the camera's.
    std::array<double, 2> elevation{}, azimuth{};
    /// Linear R, G, B; 1: white in the pictures.
    std::array<double, 3> radiance{};
    double share = 0;  ///< of the light that the stone takes into the camera at equal radiances
};

/// Scores of a frame left out against the same render turned and mirrored in the picture's plane
/// (compare/scores).
struct FrameLikeness {
    std::size_t frame = 0;
    Score zncc, coarse;  ///< seen through a blur of 2 % and 4 % of the stone
};

struct SeriesLight {
    std::vector<ZoneLight> zones;
    int frames = 0;  ///< that the light was estimated from
    std::vector<FrameLikeness> left_out;
    /// Means over the frames left out; their null's draws are means of one draw of each.
    Score mean, coarse_mean;
    std::string verdict;  ///< for people; empty without frames left out
    std::string beside;   ///< bytes of a PNG: the frames left out, the renders beside them
};

/// The stone is drawn as completed, if it was. `material`: of the stone, taken as clear. The result
/// does not depend on `threads`.
SeriesLight series_light(const std::vector<SpinFrame>& frames, const SpinResult& found,
                         const Material& material, int threads = 0);

/// Scores so many deviations above those of turned renders are beyond chance.
inline constexpr double k_beyond_chance = 3;

}  // namespace culet
