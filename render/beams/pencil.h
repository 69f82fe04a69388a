#pragma once
// What an eye sees of the unfolded stone through one front facet, near one ray, as one projective
// map: a pencil of rays, to first order.
//
// Unfolded: after each reflection the stone is mirrored instead of the ray, which so runs straight
// on from where it entered.
//
// About the ray that enters at x0 under the angle ti to the facet's normal N and goes on under tt,
// the eye at distance D: a point at the depth z = -N.(X - x0) below the facet and beside the ray by
// aT along the tangential and aS along the sagittal direction T, S of the facet appears where
//     x0 (1 + z k) + aT fT T + aS fS S,   w = 1 + z k
// would without refraction. kS = 1/(n D cos tt), kT = kS cos^2 ti / cos^2 tt, k their mean, and
// fT = (1 + z* k)/(1 + z* kT), fS likewise, with the depth z* where exactness is wanted: there the
// map is exact to first order, astigmatism included (a refracted narrow pencil has two image
// points, whose distances are in the ratio cos^2 ti : n^2 cos^2 tt over n; Coddington 1829).

#include <array>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "render/beams/screen_view.h"

namespace culet {

/// From the unfolded space to the stone that the ray runs in: turn (and mirror), then shift.
struct Folding {
    glm::dmat3 turn{1};
    Vec3 shift{0};

    Vec3 point(const Vec3& p) const { return turn * p + shift; }
    /// Mirrored once more, at a plane of the stone.
    Folding mirrored(const Plane& plane) const;
};

/// One eye ray inside the stone, unfolded.
struct InsideRay {
    Vec3 x0{0}, direction{0};  ///< entry, and unit direction inside
};

/// One eye ray inside the stone, and those about it.
struct Pencil : InsideRay {
    Vec3 normal{0};  ///< of the front facet, outwards
    Vec3 tangential{0}, sagittal{0};
    double cos_i = 1, cos_t = 1, k_t = 0, k_s = 0;
    ScreenImage image_x0{0}, image_t{0}, image_s{0};
};

/// The ray of `view` through `at`, refracted at the plane into the index `n` (over the outside's).
Pencil pencil_through(const ScreenView& view, const ScreenPoint& at, const Plane& front, double n);
InsideRay ray_through(const ScreenView& view, const ScreenPoint& at, const Plane& front, double n);

/// Image of points of the stone that `folding` leads to, as rows of a 3 x 4 matrix.
struct PencilMap {
    std::array<double, 12> m{};
    ScreenImage of(const Vec3& p) const {
        return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
                m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
    }
};
/// `depth`: z*, of the point that the ray hits next.
PencilMap map_of(const Pencil& pencil, Refraction refraction, const Folding& folding, double depth);

}  // namespace culet
