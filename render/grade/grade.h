#pragma once
// Figures of the trade for a cut's optical performance, from exact beams (docs/grade.md). Fractions
// of the eye's light unless noted; angles in radians.
//
// The stone is treated as clear, because colour belongs to the material, not to the cut. A crystal
// is graded with the mean of its principal indices, both waves on one path.

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

/// Wavelength at which the trade states indices.
inline constexpr double k_grade_nm = k_d_line_nm;
/// Largest tilt that may be requested; near 90 degrees nothing is visible through the crown.
inline constexpr double k_most_tilt_deg = 85;

struct GradeIndex {
    double n = 1.5;                             ///< at k_grade_nm
    std::optional<std::array<double, 3>> fire;  ///< at k_fire_nm; none: the dispersion is unknown
};

/// For a crystal, the mean of its principal indices. `n` shifts the indices to it. Throws
/// InternalError without material and `n`.
GradeIndex grade_index(const Material* material, std::optional<double> n);

struct GradeOptions {
    double head = radians(10);       ///< half angle of the viewer's head
    double view_cone = radians(64);  ///< of useful return
    double light_cone = radians(7);  ///< of the light for balance and fire
    std::vector<double> tilts;
    /// Azimuths of the tilt axes. Rotations are left-handed, like GemRay's.
    std::vector<double> tilt_axes{0, radians(90)};
    std::uint64_t seed = 1;  ///< of the random sky
    int map_size = 600;      ///< points per side of the maps of hearts and arrows
    int threads = 0;
    /// Fewer directions and points, for the spread of figures over many stones.
    bool coarse = false;
};

/// All models about one axis.
struct TiltCurve {
    double axis = 0;
    std::vector<ViewReturn> returns;  ///< per GradeOptions::tilts
};

struct Grade {
    GradeIndex index;
    double silhouette_area = 0;  ///< face up, in square units of the solid
    int table = -1;              ///< facet; -1: none
    ViewReturn face_up;
    std::vector<double> tilts;
    std::vector<TiltCurve> curves;
    AsetShares aset, aset_table;
    TableReflection table_reflection;
    ScopeShares ideal_scope;
    double dark_field = 0;
    LightBalance balance;
    double weighted_return = 0;  ///< GIA's; see light_return.h
    /// Part of a uniform hemisphere's light that a black cone of the viewer's head blocks.
    double head_shadow = 0;
    std::optional<Fire> fire;
    Hearts hearts;
    Arrows arrows;
};

/// Throws InputError for a stone that is not closed and convex, and for an index of 1 or less; and
/// Interrupted. The result does not depend on the number of threads.
Grade grade_stone(const Solid& solid, const GradeIndex& index, const GradeOptions& options,
                  const Progress& progress = {});

/// The same for a stone known to be closed and convex.
Grade grade_convex(const Solid& solid, const GradeIndex& index, const GradeOptions& options,
                   const Progress& progress = {});

/// Direction to the eye in the stone's frame, after a left-handed rotation of the stone by `tilt`
/// about the level axis at `axis`. A positive tilt about x lifts the edge at -y, about y that at
/// +x.
Vec3 eye_over_tilted(double tilt, double axis);

/// Directions in a cone around +z, even for cosine-weighted light: `each` directions in each ring.
std::vector<Vec3> cone_directions(double half_angle, int rings, int each);

/// Directions of the hemisphere: rings of equal solid angle with `each` directions.
std::vector<Vec3> hemisphere_directions(int rings, int each);

/// Per facet: whether it faces up (crown and table); light leaving there counts as the crown's.
std::vector<bool> crown_facets(const Solid& solid);

}  // namespace culet
