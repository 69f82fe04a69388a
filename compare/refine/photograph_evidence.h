#pragma once
// What one photograph of known light says about the planes of the stone in it: the front door of
// compare/refine. Plain data in and out. Lengths in the stone's unit, angles in radians.

#include <memory>
#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "compare/refine/plane_moves.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

struct PlaneEvidence {
    /// For each row, the sum over the solid's facets of normal . dn + offset * dd is `value`,
    /// within 1 and independently of the other rows; dn, dd: what the planes of the true stone are
    /// off. Blind to how the stone as a whole is turned.
    struct Row {
        std::vector<PlaneSlopes> facets;
        double value = 0;
    };
    std::vector<Row> rows;
    double moves_told = 0;  ///< of three a facet, how many the photograph tells
};

/// Where the photograph shows what the stone does not.
struct Contradiction {
    double x = 0, y = 0;       ///< pixels of the photograph
    std::string facet;         ///< through which it is seen
    bool is_brighter = false;  ///< in the photograph
    double deviations = 0;     ///< over what is usual in this photograph
    double area = 0;           ///< as a share of the stone
};

struct EvidenceFit {
    /// Root mean square difference of the two pictures, in the root of light (white is 1).
    double rms = 0;
    std::vector<Contradiction> contradictions;  ///< the strongest first
};

/// Keeps what is known of how the photograph was taken: exposure, place in the picture, and small
/// turns of light and camera (set_up.h), which get better with the stone.
class PhotographEvidence {
public:
    /// `scene`: with the camera of the photograph's pose, and the stone as it is known at first;
    /// convex. Throws InputError as `render` does, where the photograph's
    /// stone is not the scene's by its outline, and where the scene can only be drawn by rays.
    PhotographEvidence(const Photo& photo, const Scene& scene, int threads);
    ~PhotographEvidence();
    PhotographEvidence(PhotographEvidence&&) noexcept;

    /// How the picture must change is found out around `solid`, facet by facet, two sketches for
    /// each move; unless it is not to be sketched anew: a stone that has moved little changes as it
    /// did. `spread`: standard deviation of each move (three a facet). `blur`: of both pictures, a
    /// share of the diameter: as large as reflexes may be out of place.
    PlaneEvidence measure(const Solid& solid, const std::vector<double>& spread, double blur,
                          bool sketch_anew, const Progress& progress = {});

    /// After `measure`: takes the set-up that suits this stone best, near the one that was
    /// measured.
    void settle(const Solid& solid);

    /// How well the stone explains the photograph in the set-up as it is known.
    EvidenceFit fit_of(const Solid& solid) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace culet
