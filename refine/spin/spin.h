#pragma once
// A convex stone from photographs of it on a turntable, in any light, before a plain ground.
//
// The outlines' common tangent planes tell how the turntable stood and how far the stone turned;
// then facets, turns and camera are fitted together to the edges in the pictures. What no outline
// shows is not known: the table and flat facets beside it, if the camera looks down on the stone.

#include <optional>
#include <string>
#include <vector>

#include "compare/turntable/edge_points.h"
#include "fit/silhouettes/turning_fit.h"
#include "refine/spin/halves.h"
#include "refine/spin/joint_fit.h"
#include "refine/spin/spin_proportions.h"
#include "stone/progress/progress.h"

namespace culet {

struct SpinFrame {
    std::string name;
    LevelPicture picture;
    bool held_out = false;  ///< only its turn is found
};

struct SpinOptions {
    /// Radians from one frame to the next, in any sense; 0: one turn over all frames.
    double step = 0;
    /// That the stone was cut with; without it, a stone may repeat its facets after half a turn.
    std::optional<CutSymmetry> symmetry = {};
    int threads = 0;  ///< 0: all; the result does not depend on it
};

struct SpinFrameResult {
    bool used = false;
    /// Of the stone, counter-clockwise from above, radians; without one: no outline was found.
    std::optional<double> turn;
    double turn_sigma = 0;
    /// Of the edge's places from the outline of the stone that is written.
    double rms_px = 0, median_px = 0;
    double line_median_px = 0;  ///< on sides of at least `k_long_side` of the stone's width
    std::string trouble;        ///< why it was not used, for people
    Projection projection{};
};

struct SpinResult {
    /// Lengths in pixels at the turntable's axis. It stands upright (stone_attitude.h), x along its
    /// least width.
    Solid solid;
    std::vector<double> tilt_sigmas;  ///< by facet, radians
    std::vector<int> unseen;          ///< facets whose tilt is hardly more than a guess
    std::vector<int> copies;          ///< facets that are taken from where the cut repeats them
    /// The width is in pixels. A sigma is at least half of how far the halves' values differ.
    std::vector<SpinProportion> proportions;
    const SpinProportion& width() const { return proportions.front(); }
    TurningCamera camera;
    std::vector<SpinFrameResult> frames;
    Halves halves;  ///< every other frame against the rest
    CutSymmetry tried;
    std::optional<FoundSymmetry> symmetry;  ///< nothing: the stone does not repeat its facets so
    /// Edges of the surface that tell table and crown; 0: none were found, and no facet is T.
    int edges = 0;
    double edge_sigma_px = 0;
    /// Part of the ground's grain that turns with the stone; camera and turns are the ground's if
    /// it is large enough (ground_texture.h).
    double ground_agreement = 0;
    double tangent_px = 0;  ///< rms disagreement of the first outlines at common tangent planes
    double scatter_px = 0;  ///< robust standard deviation of the edges about the stone's outlines
    std::vector<std::string> notes;  ///< what is odd about the series, for people
    /// Why the result should not be trusted, and what to do, for people; empty: it can.
    std::string trouble, remedy;
};

/// Throws InputError if fewer than `k_least_frames` frames show a stone, or if no stone has such
/// outlines.
SpinResult spin(const std::vector<SpinFrame>& frames, const SpinOptions& options = {},
                const Progress& progress = {});

inline constexpr int k_least_frames = 8;
inline constexpr double k_long_side = 0.125;

}  // namespace culet
