#pragma once
// What a cut does with light: figures of the trade from exact beams (docs/grade.md). Fractions of
// the eye's light unless said otherwise; angles in radians.
//
// The stone is clear: its colour is its material's, not its cut's. A crystal is graded with the
// mean of its principal indices, both waves going one way.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/grade/fire.h"
#include "render/grade/hearts_arrows.h"
#include "render/grade/light_return.h"
#include "render/grade/scope_shares.h"
#include "stone/material/material.h"
#include "stone/numbers/units.h"
#include "stone/progress/progress.h"

namespace culet {

/// At which the trade states indices.
inline constexpr double k_grade_nm = k_d_line_nm;
/// People may ask for tilts to this; nearer to 90 degrees nothing is seen through the crown.
inline constexpr double k_most_tilt_deg = 85;

struct GradeIndex {
    double n = 1.5;                             ///< at k_grade_nm
    std::optional<std::array<double, 3>> fire;  ///< at k_fire_nm; none: no dispersion is known
};

/// Of a crystal the mean of its principal indices. With `n` the indices are shifted to it; with
/// neither material nor `n`: InternalError.
GradeIndex grade_index(const Material* material, std::optional<double> n);

struct GradeOptions {
    double head = radians(10);       ///< half angle of the viewer's head
    double view_cone = radians(64);  ///< of useful return
    double light_cone = radians(7);  ///< of the light of balance and fire
    std::vector<double> tilts;
    /// Azimuths of the axes about which the stone is tilted: left-handed, as GemRay's tilts are.
    std::vector<double> tilt_axes{0, radians(90)};
    std::uint64_t seed = 1;  ///< of the uneven sky
    int map_size = 600;      ///< points along a side of the maps of hearts and arrows
    int threads = 0;
    /// Fewer directions and points, for figures whose scatter over many stones is wanted.
    bool coarse = false;
};

/// Every model about one axis.
struct TiltCurve {
    double axis = 0;
    std::vector<ViewReturn> returns;  ///< by GradeOptions::tilts
};

struct Grade {
    GradeIndex index;
    double silhouette_area = 0;  ///< face up, in square units of the solid
    int table = -1;              ///< facet; -1: there is none
    ViewReturn face_up;
    std::vector<double> tilts;
    std::vector<TiltCurve> curves;
    AsetShares aset, aset_table;
    TableReflection table_reflection;
    ScopeShares ideal_scope;
    double dark_field = 0;
    LightBalance balance;
    double weighted_return = 0;  ///< GIA's, see light_return.h
    /// Of a uniform hemisphere's light, what a black cone of the viewer's head takes away.
    double head_shadow = 0;
    std::optional<Fire> fire;
    Hearts hearts;
    Arrows arrows;
};

/// Throws InputError for a stone that is not closed and convex, and for an index of 1 or less;
/// Interrupted. The result does not depend on the number of threads.
Grade grade_stone(const Solid& solid, const GradeIndex& index, const GradeOptions& options,
                  const Progress& progress = {});

/// The same of a stone that is known to be closed and convex.
Grade grade_convex(const Solid& solid, const GradeIndex& index, const GradeOptions& options,
                   const Progress& progress = {});

/// Towards the eye, in the stone's frame, after the stone has turned by `tilt`, left-handed, about
/// the level axis at `axis`: a positive tilt about x lifts the edge at -y, one about y that at +x.
Vec3 eye_over_tilted(double tilt, double axis);

/// Directions of a cone round +z, as evenly as its cosine-weighted light: rings of so many each.
std::vector<Vec3> cone_directions(double half_angle, int rings, int each);

/// Directions of the hemisphere, rings of equal solid angle with so many each.
std::vector<Vec3> hemisphere_directions(int rings, int each);

/// By facet: whether it looks up (crown and table), as light that leaves through it is the crown's.
std::vector<bool> crown_facets(const Solid& solid);

}  // namespace culet
