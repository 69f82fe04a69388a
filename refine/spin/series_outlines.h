#pragma once
// Stone, camera and turns by the outlines of a series and the grain of its ground.

#include <array>
#include <vector>

#include "refine/spin/ground_texture.h"
#include "refine/spin/series_faults.h"
#include "refine/spin/spin.h"
#include "stone/numbers/units.h"

namespace culet {

struct SeriesOutlines {
    std::vector<CoarseOutline> coarse;  ///< by frame; its trouble says why a frame is not used
    std::vector<PicturePoints> edges;   ///< by frame, of those used
    std::vector<std::size_t> used;      ///< frames
    double step = 0;                    ///< radians from frame to frame, with the sense of turning
    double tangent_px = 0;              ///< as SpinResult
    ExpectedSeries expected;            ///< of the frames used
    SeriesFaults faults;
    GroundTexture ground;
    bool has_ground = false;
    TurningFit fit;
    std::array<TurningFit, 2> halves;  ///< of every other frame used

    /// Along the outline that the fit's stone has after this turn, within `reach` pixels.
    PicturePoints edges_at(const LevelPicture& picture, double turn, double reach) const;
};

/// Pixels from the expected outline: first as the coarse outlines tell it, then as the edges do.
inline constexpr double k_first_reach = 4, k_reach = 2.5;
/// Of a turn that the ground tells, as halves of a real series differ; radians.
inline constexpr double k_ground_turn_sigma = radians(0.03);

/// Throws as `spin` does. `step` as in SpinOptions. `progress`: to 0.85.
SeriesOutlines series_outlines(const std::vector<SpinFrame>& frames, double step,
                               const Progress& progress);

}  // namespace culet
