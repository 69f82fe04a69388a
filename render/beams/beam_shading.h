#pragma once
// Light along a beam's rays, each followed exactly along the beam's facets, without searching, many
// at once. Single precision relative to the stone's middle (regions are computed in double).
//
// As in light_paths.h, polarised light carries the Stokes parameters of two orthogonal eye
// polarisations, turned from face to face by products of normals alone.

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

/// The stone relative to `middle`.
struct ShadedStone {
    explicit ShadedStone(const FacetNet& net);

    struct Side {
        float x, y, z, offset;
    };
    struct Face {
        float x, y, z, offset;
        std::uint32_t first_side, sides;  ///< sides that bound the facet in its plane
    };
    Vec3 middle{0};
    float size = 1;
    std::vector<Face> faces;
    std::vector<Side> sides;
};

/// Optics of one band of wavelengths.
struct ShadedOptics {
    float n = 1.5f;  ///< relative to the outside
    bool polarised = true;
    std::vector<float> absorption;  ///< per node and length; empty: clear
    /// With either of these there is one node, and `polarised` is set.
    std::optional<MergedCrystal> crystal;
    /// The eye's response to the four Stokes parameters (stokes.h); none: S0 of unpolarised lights.
    std::optional<std::array<float, 4>> response;

    bool absorbs() const { return crystal || !absorption.empty(); }
};

/// An eye ray and its derivatives, at the beam's first facet, relative to the stone's middle.
struct ShadedEye {
    float point[3], direction[3];          ///< entry point and unit direction
    float point_x[3], point_y[3];          ///< change of the point per pixel, at the same distance
    float direction_x[3], direction_y[3];  ///< change of the direction
    float origin_x[3], origin_y[3];        ///< change of the eye ray's origin
    float distance = 0;                    ///< from the origin to the point
    float forward[3], right[3];            ///< of the camera (EyeFrame), for polarised light
};
ShadedEye shaded_eye(const ScreenView& view, const ScreenPoint& at, const Plane& front,
                     const Vec3& middle);
/// The same without a facet: the point is the ray's origin.
ShadedEye shaded_eye(const ScreenView& view, const ScreenPoint& at, const Vec3& middle);

/// The rays of one beam. Arrays need room for `k_shading_room` more.
struct Fragments {
    const float *x = nullptr, *y = nullptr;  ///< pixels from the reference eye ray
    int count = 0;
    /// Parts of the pixels to shade, as in CoveredPixels; null: whole pixels.
    const float *xx = nullptr, *yx = nullptr, *yy = nullptr;
    /// The region that the parts belong to, and the reference eye ray's place in the picture; null:
    /// unknown.
    const ScreenPoint* corners = nullptr;
    std::size_t corner_count = 0;
    ScreenPoint reference{0, 0};
    /// Output: radiance of node i in radiance[i * stride + fragment].
    float* radiance = nullptr;
    int stride = 0;
    float* left = nullptr;      ///< share of the eye's unit of light still inside at the end
    float* absorbed = nullptr;  ///< or null
    /// For near lights in front of the stone: the share of a pixel that they leave free, and their
    /// own radiance by node. Both or none.
    float *unhidden = nullptr, *before = nullptr;
    /// 1 if the ray meets exactly these facets, else 0; null: not checked.
    float* verified = nullptr;
    bool soft = false;  ///< average lights' edges over a pixel
};
constexpr int k_shading_room = 16;

struct ShadingJob {
    const ShadedStone* stone = nullptr;
    const ShadedOptics* optics = nullptr;
    const ShadedLights* lights = nullptr;
};

/// Follows the fragments' rays along `facets`, front facet first.
void shade_beam(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                int facet_count, const Fragments& fragments);

/// Light that leaves the stone, to first order over a small region of the picture: value, x
/// derivative, y derivative.
struct ShadedLeaving {
    float point[3][3], direction[3][3];
    float s[3][3];                   ///< with the direction: the frame of Q and U
    float weight[3], Q[3], U[3];     ///< before absorption
    std::vector<float> transmitted;  ///< 3 per node
    bool polarised = false;          ///< Q and U are used
};
/// `fragments` are relative to the reference point; only the radiance is written.
void shade_leaving(const ShadedLights& lights, const ShadedLeaving& leaving,
                   const Fragments& fragments);

/// One row of pixels and the share of each that the stone fills.
struct BareRow {
    float x = 0, y = 0;  ///< middle of the first pixel, from the reference eye ray
    int count = 0;
    const float* cover = nullptr;
    float* radiance = nullptr;  ///< node * stride + pixel: added to
    std::size_t stride = 0;
    float factor = 1;
    bool soft = false;
};
/// Adds the lights that the eye sees directly beside the stone. The reference ray starts at
/// `eye.point`.
void shade_background(const ShadedLights& lights, const ShadedOptics& optics, const ShadedEye& eye,
                      const BareRow& row);

/// Instruction sets compiled in that this processor has, best first; the first is used. The
/// portable one is "EMU128" or "SSE2".
std::vector<std::string> shading_targets();
/// Selects one by name; false if there is none. For tests.
bool use_shading_target(const std::string& name);

}  // namespace culet
