#pragma once
// What one photograph in known light says about its stone's planes. The public interface of
// compare/refine: plain data in and out. Lengths in the stone's unit, angles in radians.

#include <memory>
#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "compare/refine/plane_moves.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

struct PlaneEvidence {
    /// The sum over the facets of normal . dn + offset * dd is `value` with sigma 1, independently
    /// of other rows; dn, dd: the true planes minus the solid's. A rotation of the whole stone does
    /// not matter.
    struct Row {
        std::vector<PlaneSlopes> facets;
        double value = 0;
    };
    std::vector<Row> rows;
    double parameters_determined = 0;  ///< of the planes, which have three each
};

/// A place where the photograph disagrees with the stone.
struct Contradiction {
    double x = 0, y = 0;       ///< pixels of the photograph
    std::string facet;         ///< through which it is seen
    bool is_brighter = false;  ///< in the photograph
    double deviations = 0;     ///< size, relative to the usual difference in this photograph
    double area = 0;           ///< share of the stone
};

struct EvidenceFit {
    /// Root mean square difference of the two pictures, in the root of light (white is 1).
    double rms = 0;
    std::vector<Contradiction> contradictions;  ///< strongest first
};

/// Keeps the photograph's set-up, which improves with the stone: exposure, place, and small
/// rotations of light and camera (set_up.h).
class PhotographEvidence {
public:
    /// `scene`: with the photograph's camera and the initial stone, which must be convex. Throws
    /// InputError as `render` does, when the outlines do not fit, and when the scene can only be
    /// ray-traced.
    PhotographEvidence(const Photo& photo, const Scene& scene, int threads);
    ~PhotographEvidence();
    PhotographEvidence(PhotographEvidence&&) noexcept;

    /// Finds how the picture changes with the planes around `solid`, by two sketches for each move.
    /// `sketch_anew` false: keeps the last changes, which still hold for a stone that moved little.
    /// `spread`: prior sigma of each move (three per facet). `blur`: of both pictures, a share of
    /// the diameter; as large as reflexes may be displaced.
    PlaneEvidence measure(const Solid& solid, const std::vector<double>& spread, double blur,
                          bool sketch_anew, const Progress& progress = {});

    /// Call after `measure`: takes the set-up near the measured one that fits this stone best.
    void settle(const Solid& solid);

    /// In the current set-up.
    EvidenceFit fit_of(const Solid& solid) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace culet
