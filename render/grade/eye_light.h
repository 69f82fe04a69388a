#pragma once
// Traces light from an eye infinitely far away into a convex stone. By reversibility, the part that
// exits along a direction is the part of the light from there that the eye sees.
//
// All rays of a beam (render/beams) hit the same facets, and for a parallel eye they are parallel.
// So areas, directions and weights are exact for each beam, and continuous in the facets' angles.
// Unpolarised Fresnel reflection splits the power at every face; polarisation is not carried on, as
// in the programs used for comparison (docs/grade.md).

#include <functional>
#include <vector>

#include "render/beams/beam_tree.h"
#include "render/beams/facet_net.h"

namespace culet {

/// Light that exits through one face after one sequence of facets.
struct EyeExit {
    int front = 0;         ///< index in EyeLight::fronts
    int parent = -1;       ///< index in EyeLight::exits of the previous face; -1: the front facet
    int facet = 0;         ///< where it exits; index in the solid
    int faces = 2;         ///< hit so far, including the front one and this one
    double area = 0;       ///< of the beam, across the line of sight; square units of the solid
    double weight = 0;     ///< leaving, relative to the eye's light; 0: total reflection
    Vec3 direction{0};     ///< unit, outwards; not set if the weight is 0
    Vec3 inside{0};        ///< unit, before the face
    double remaining = 0;  ///< reflected back inside, relative to the eye's light
};

struct EyeFront {
    int facet = 0;
    double area = 0;         ///< across the line of sight
    double reflectance = 0;  ///< of the outer face
    Vec3 reflected{0};       ///< unit
    /// Area times weight of the light that was not followed further.
    double residual = 0;
};

struct EyeLight {
    Vec3 towards_eye{0, 0, 1};
    double area = 0;  ///< of the silhouette
    std::vector<EyeFront> fronts;
    std::vector<EyeExit> exits;  ///< each after its parent
    /// If requested: a convex outline for each exit in the plane across the line of sight, along
    /// `right` and `up`, from the solid's origin.
    std::vector<std::vector<ScreenPoint>> regions;
    Vec3 right{1, 0, 0}, up{0, 1, 0};
};

struct EyeLightLimits {
    int faces = 10;            ///< most faces hit, including the front one
    double cut_weight = 1e-3;  ///< light of less weight is not followed further
    bool regions = false;
};

class EyeLightTracer {
public:
    /// `convex` must be convex. Throws InputError if the planes bound no solid. `goes_on` is asked
    /// now and then, from any thread; if false, `trace` throws Interrupted.
    explicit EyeLightTracer(const Solid& convex, std::function<bool()> goes_on = {});

    /// `towards_eye`: unit. `n`: index relative to the outside's, above 1. The result does not
    /// depend on the number of threads.
    EyeLight trace(const Vec3& towards_eye, double n, const EyeLightLimits& limits = {}) const;

private:
    Camera camera_towards(const Vec3& towards_eye) const;

    FacetNet net_;
    Vec3 middle_{0};
    double diameter_ = 1;
    std::function<bool()> goes_on_;
};

}  // namespace culet
