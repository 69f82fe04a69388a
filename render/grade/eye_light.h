#pragma once
// Where light goes that an eye infinitely far away would send into a convex stone. Light runs the
// same way back: a share that leaves along a direction is the share of what comes from there that
// the eye sees.
//
// By beams (render/beams): all rays of a beam meet the same facets, and of a parallel eye they are
// parallel, so that areas, directions and weights are exact for each beam as a whole, and
// continuous in the facets' angles. Power is split at every face by unpolarised Fresnel reflection;
// polarisation is not carried from face to face, as in the programs whose figures are compared
// (docs/grade.md).

#include <functional>
#include <vector>

#include "render/beams/beam_tree.h"
#include "render/beams/facet_net.h"

namespace culet {

/// What leaves through one face at the end of one sequence of facets.
struct EyeExit {
    int front = 0;         ///< index in EyeLight::fronts
    int parent = -1;       ///< index in EyeLight::exits of the face before; -1: the front facet
    int facet = 0;         ///< where it leaves; the solid's index
    int faces = 2;         ///< met so far, the front one and this one included
    double area = 0;       ///< of the beam, across the line of sight; square units of the solid
    double weight = 0;     ///< leaving, of the eye's unit of light; 0: total reflection
    Vec3 direction{0};     ///< unit, outwards; not set where the weight is 0
    Vec3 inside{0};        ///< unit, before the face
    double remaining = 0;  ///< reflected back inside, of the eye's unit of light
};

struct EyeFront {
    int facet = 0;
    double area = 0;         ///< across the line of sight
    double reflectance = 0;  ///< at the outer face
    Vec3 reflected{0};       ///< unit
    /// Area times weight of what was not followed further.
    double residual = 0;
};

struct EyeLight {
    Vec3 towards_eye{0, 0, 1};
    double area = 0;  ///< of the silhouette
    std::vector<EyeFront> fronts;
    std::vector<EyeExit> exits;  ///< each after its parent
    /// With regions: of each exit, a convex outline in the plane across the line of sight, along
    /// `right` and `up`, from the solid's origin.
    std::vector<std::vector<ScreenPoint>> regions;
    Vec3 right{1, 0, 0}, up{0, 1, 0};
};

struct EyeLightLimits {
    int faces = 10;            ///< met at most, the front one included
    double cut_weight = 1e-3;  ///< what carries less is not followed further
    bool regions = false;
};

class EyeLightTracer {
public:
    /// Throws InputError when the planes bound no solid. `convex` must be.
    /// `goes_on` is asked now and then, from any thread: where it says no, `trace` throws
    /// Interrupted.
    explicit EyeLightTracer(const Solid& convex, std::function<bool()> goes_on = {});

    /// `towards_eye`: unit. `n`: index over the outside's, above 1. The result does not depend on
    /// the number of threads.
    EyeLight trace(const Vec3& towards_eye, double n, const EyeLightLimits& limits = {}) const;

private:
    Camera camera_towards(const Vec3& towards_eye) const;

    FacetNet net_;
    Vec3 middle_{0};
    double diameter_ = 1;
    std::function<bool()> goes_on_;
};

}  // namespace culet
