#pragma once
// Light of a beam's rays, each followed exactly along the facets that the beam names: no search,
// many rays at once, in single precision about the stone's middle (the regions come from double).
//
// What is carried is that of light_paths.h: with polarisation the Stokes parameters of two
// orthogonal eye polarisations, turned from face to face by products of normals alone.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/beams/beam_lights.h"
#include "render/beams/facet_net.h"
#include "render/beams/screen_view.h"
#include "render/optics/merged_crystal.h"

namespace culet {

/// The stone as the shading wants it, about `middle`.
struct ShadedStone {
    explicit ShadedStone(const FacetNet& net);

    struct Side {
        float x, y, z, offset;
    };
    struct Face {
        float x, y, z, offset;
        std::uint32_t first_side, sides;  ///< a point of the plane is on the facet within all sides
    };
    Vec3 middle{0};
    float size = 1;
    std::vector<Face> faces;
    std::vector<Side> sides;
};

/// Light's way through the stone for one band of wavelengths.
struct ShadedOptics {
    float n = 1.5f;  ///< over the outside's
    bool polarised = true;
    std::vector<float> absorption;  ///< of each node, per length; empty: clear
    /// Where either is wanted there is one node, and `polarised`.
    std::optional<MergedCrystal> crystal;
    /// What the eye responds to of the four Stokes parameters (stokes.h); none: S0 of unpolarised
    /// lights.
    std::optional<std::array<float, 4>> response;

    bool absorbs() const { return crystal || !absorption.empty(); }
};

/// Eye rays about one of them, at the beam's first facet. All about the stone's middle.
struct ShadedEye {
    float point[3], direction[3];          ///< where it enters, and its unit direction
    float point_x[3], point_y[3];          ///< its change from pixel to pixel, at the same distance
    float direction_x[3], direction_y[3];  ///< and of the direction
    float origin_x[3], origin_y[3];        ///< and of where the eye ray starts
    float distance = 0;                    ///< from there to the point
    float forward[3], right[3];            ///< of the camera (EyeFrame), for polarised light
};
ShadedEye shaded_eye(const ScreenView& view, const ScreenPoint& at, const Plane& front,
                     const Vec3& middle);
/// The same where no facet is met: the point is where the ray starts.
ShadedEye shaded_eye(const ScreenView& view, const ScreenPoint& at, const Vec3& middle);

/// The rays of one beam; the arrays have room for `k_shading_room` more.
struct Fragments {
    const float *x = nullptr, *y = nullptr;  ///< pixels from the eye ray of reference
    int count = 0;
    /// The part of each pixel whose light is wanted, as CoveredPixels has it; null: all of it.
    const float *xx = nullptr, *yx = nullptr, *yy = nullptr;
    /// With these, the region that the parts are of, and the eye ray of reference in the picture;
    /// null: not known.
    const ScreenPoint* corners = nullptr;
    std::size_t corner_count = 0;
    ScreenPoint reference{0, 0};
    /// Radiance of node i in radiance[i * stride + fragment]: overwritten.
    float* radiance = nullptr;
    int stride = 0;
    float* left = nullptr;      ///< what of the eye's unit of light is still inside at the end
    float* absorbed = nullptr;  ///< or null
    /// Where near lights may stand before the stone: the share of a pixel that they leave free, and
    /// their own radiance, likewise by node. Both or none.
    float *unhidden = nullptr, *before = nullptr;
    /// 1 where the ray does meet these facets and no others, else 0; null: not looked at.
    float* follows = nullptr;
    bool soft = false;  ///< lights' edges are averaged over a pixel
};
constexpr int k_shading_room = 16;

struct ShadingJob {
    const ShadedStone* stone = nullptr;
    const ShadedOptics* optics = nullptr;
    const ShadedLights* lights = nullptr;
};

/// Follows the fragments' rays along `facets`, the front one first.
void shade_beam(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                int facet_count, const Fragments& fragments);

/// What leaves the stone, to first order over a small region of the picture: value, change to the
/// right, change down.
struct ShadedLeaving {
    float point[3][3], direction[3][3];
    float s[3][3];                   ///< with the direction, the frame of Q and U
    float weight[3], Q[3], U[3];     ///< before absorption
    std::vector<float> transmitted;  ///< 3 for each node
    bool polarised = false;          ///< Q and U count
};
/// `fragments` are about the point of reference; only the radiance is written.
void shade_leaving(const ShadedLights& lights, const ShadedLeaving& leaving,
                   const Fragments& fragments);

/// One row of pixels and how much of each the stone fills.
struct BareRow {
    float x = 0, y = 0;  ///< the first pixel's middle, from the eye ray of reference
    int count = 0;
    const float* cover = nullptr;
    float* radiance = nullptr;  ///< node * stride + pixel: added to
    std::size_t stride = 0;
    float factor = 1;
    bool soft = false;
};
/// Adds the lights that the eye itself sees beside the stone; its reference ray starts at
/// `eye.point`.
void shade_background(const ShadedLights& lights, const ShadedOptics& optics, const ShadedEye& eye,
                      const BareRow& row);

/// Instruction sets that this processor has of those that were compiled, best first; the first is
/// used. "EMU128" or "SSE2" is the portable one.
std::vector<std::string> shading_targets();
/// Uses the named one from now on; false when there is no such. For tests.
bool use_shading_target(const std::string& name);

}  // namespace culet
