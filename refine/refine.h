#pragma once
// Front door of the room: fits a stone to its readings, outlines and photographs in known light
// together.
//
// A photograph of a faceted stone shows hundreds of reflexes, which move by several times the angle
// by which a facet turns. The program draws how each facet's small turns and shift change the
// picture; compared with the photograph, this gives plane observations (compare/refine), one more
// reading for the fit. Reflexes move linearly only over short distances, so this is repeated from
// the resulting stone, with blurred pictures first.

#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "fit/fit.h"
#include "render/scene/scene.h"

namespace culet {

struct RefinePhotograph {
    std::string name;  ///< id of its reading
    Photo photo;
    /// Where it was taken from, in the scene; empty: near the scene's camera.
    std::optional<Camera> camera = {};
};

struct RefineOptions {
    FitOptions fit;
    bool find_pose = true;  ///< false: every photograph has the scene's camera
    int threads = 0;        ///< 0: all; the result does not depend on it
};

struct RefineResult {
    FitResult before;  ///< from the readings alone
    /// With the photographs, each a reading of kind `photograph`.
    FitResult after;
};

/// Describes what a photograph says of the stone: one line, and one for each contradiction.
std::vector<std::string> photograph_words(const std::string& name,
                                          const PhotographFinding& finding);

/// `scene` has the photographs' light, the material, and a camera near theirs; its stone is
/// replaced. Throws InputError with a photograph's name if it cannot be used, and as `fit_stone`
/// does.
RefineResult refine(const FitInput& input, const std::vector<RefinePhotograph>& photographs,
                    const Scene& scene, const RefineOptions& options = {},
                    const Progress& progress = {});

}  // namespace culet
