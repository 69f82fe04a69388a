#pragma once
// Front door of the room: the stone that explains its readings, its outlines and photographs of it
// in known light, all together.
//
// A photograph of a faceted stone shows hundreds of reflexes, which move by several times the angle
// that a facet is turned. What each facet's small turns and shift change in the picture is drawn;
// held against what the photograph differs by, that tells of the planes (compare/refine). The fit
// takes it as one more reading, with its uncertainty; and as reflexes do not move straight for
// long, this is done again from the stone that comes out, first with blurred pictures.

#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "fit/fit.h"
#include "render/scene/scene.h"

namespace culet {

struct RefinePhotograph {
    std::string name;  ///< its reading's id
    Photo photo;
    /// Where it was taken from, in the scene; none: near the scene's camera.
    std::optional<Camera> camera = {};
};

struct RefineOptions {
    FitOptions fit;
    bool find_pose = true;  ///< false: the scene's camera is that of every photograph
    int threads = 0;        ///< 0: all; the result does not depend on it
};

struct RefineResult {
    FitResult before;  ///< by the readings alone
    /// With the photographs, each a reading of kind `photograph`.
    FitResult after;
};

/// What a photograph says of the stone, for people: one line, and one for each contradiction.
std::vector<std::string> photograph_words(const std::string& name,
                                          const PhotographFinding& finding);

/// `scene`: its light as it was at the photographs, its material, and a camera near theirs; its
/// stone is replaced. Throws InputError, with the photograph's name, for one that cannot be used,
/// and as `fit_stone` does.
RefineResult refine(const FitInput& input, const std::vector<RefinePhotograph>& photographs,
                    const Scene& scene, const RefineOptions& options = {},
                    const Progress& progress = {});

}  // namespace culet
