#pragma once
// Views worth refining: coarse search on both sides of the photograph, without views that are equal
// by symmetry.

#include <optional>

#include "compare/pose/pose_task.h"

namespace culet {

struct Candidate {
    const PhotoSide* side = nullptr;
    StoneView view;
    RefinedView refined;
    EdgeSupport support;
    CrownEvidence evidence;  ///< set by `refine_fully`
};

struct SeenView {
    const PhotoSide* side = nullptr;
    CoarseView coarse;
};

std::vector<Candidate> coarse_candidates(const PoseTask& task);

/// Views that are equivalent by the model's symmetry; first one that is not mirrored and nearest to
/// the start.
std::vector<SeenView> images_of(const PoseTask& task, const PhotoSide* side, const StoneView& view);

/// The view nearest to the start among those that differ from this one by a turn about the stone's
/// axis and look alike except for small irregularities. Nothing when none is within the search
/// range.
std::optional<StoneView> meant_look_alike(const PoseTask& task, const PhotoSide& side,
                                          const StoneView& view);

/// Not mirrored first, then by the angle to the start.
bool nearer_to_start(const PhotoSide* a_side, const StoneView& a, const PhotoSide* b_side,
                     const StoneView& b);

/// Whether it shows the side (of the stone's plane z = 0) that the start does not show.
bool shows_other_side(const PoseTask& task, const StoneView& view);

double angle_between(const StoneView& a, const StoneView& b);

/// Nearer views are the same.
constexpr double k_same_view_deg = 0.4;

}  // namespace culet
