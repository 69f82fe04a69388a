#pragma once
// The map from the unfolded stone to the picture, through one front facet and near one ray: a
// pencil of rays, to first order.
//
// Unfolded: at each reflection the stone is mirrored instead of the ray, so the ray runs straight
// on from its entry point.
//
// A ray enters at x0 at the angle ti to the facet's normal N and goes on at the angle tt; the eye
// is at the distance D. A point at the depth z = -N.(X - x0) below the facet, beside the ray by aT
// along the facet's tangential direction T and by aS along its sagittal direction S, appears where
//     x0 (1 + z k) + aT fT T + aS fS S,   w = 1 + z k
// would appear without refraction. Here kS = 1/(n D cos tt), kT = kS cos^2 ti / cos^2 tt, k is
// their mean, fT = (1 + z* k)/(1 + z* kT), and fS likewise. At the depth z* the map is exact to
// first order, including astigmatism (a refracted narrow pencil has two image points, whose
// distances are in the ratio cos^2 ti : n^2 cos^2 tt over n; Coddington 1829).

#include <array>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "render/beams/screen_view.h"

namespace culet {

/// From unfolded space to the stone that the ray runs in: rotation or reflection, then translation.
struct Folding {
    glm::dmat3 turn{1};
    Vec3 shift{0};

    Vec3 point(const Vec3& p) const { return turn * p + shift; }
    /// Mirrored at one more plane of the stone.
    Folding mirrored(const Plane& plane) const;
};

/// An eye ray inside the stone, unfolded.
struct InsideRay {
    Vec3 x0{0}, direction{0};  ///< entry point, unit direction
};

/// The same with the rays around it, to first order.
struct Pencil : InsideRay {
    Vec3 normal{0};  ///< of the front facet, outwards
    Vec3 tangential{0}, sagittal{0};
    double cos_i = 1, cos_t = 1, k_t = 0, k_s = 0;
    ScreenImage image_x0{0}, image_t{0}, image_s{0};
};

/// The eye ray through `at`, refracted at the plane. `n`: index relative to the outside.
Pencil pencil_through(const ScreenView& view, const ScreenPoint& at, const Plane& front, double n);
InsideRay ray_through(const ScreenView& view, const ScreenPoint& at, const Plane& front, double n);

/// Maps points of the folded stone to the picture: a 3 x 4 matrix by rows.
struct PencilMap {
    std::array<double, 12> m{};
    ScreenImage of(const Vec3& p) const {
        return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
                m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
    }
};
/// `depth`: z*, of the next point that the ray meets.
PencilMap map_of(const Pencil& pencil, Refraction refraction, const Folding& folding, double depth);

}  // namespace culet
