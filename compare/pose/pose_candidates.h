#pragma once
// Views worth refining: the coarse search over both sides of the photograph, without views that are
// the same but for the stone's symmetry.

#include <optional>

#include "compare/pose/pose_task.h"

namespace culet {

struct Candidate {
    const PhotoSide* side = nullptr;
    StoneView view;
    RefinedView refined;
    EdgeSupport support;
    CrownEvidence evidence;  ///< once settled
};

struct SeenView {
    const PhotoSide* side = nullptr;
    CoarseView coarse;
};

std::vector<Candidate> coarse_candidates(const PoseTask& task);

/// What the model's own symmetry makes of a view: first the one that is not mirrored and
/// nearest to the start.
std::vector<SeenView> images_of(const PoseTask& task, const PhotoSide* side, const StoneView& view);

/// Of the views that differ from this one by a turn about the stone's axis and from which it looks
/// alike but for small irregularities, the one nearest to the start; nothing when none is as near
/// as is searched.
std::optional<StoneView> meant_look_alike(const PoseTask& task, const PhotoSide& side,
                                          const StoneView& view);

/// Not mirrored comes before mirrored; of either, the one turned less.
bool nearer_to_start(const PhotoSide* a_side, const StoneView& a, const PhotoSide* b_side,
                     const StoneView& b);

/// Whether it shows the side of the stone (of its plane z = 0) that the start does not.
bool shows_other_side(const PoseTask& task, const StoneView& view);

double angle_between(const StoneView& a, const StoneView& b);

/// Views nearer than this to one another are the same.
constexpr double k_same_view_deg = 0.4;

}  // namespace culet
