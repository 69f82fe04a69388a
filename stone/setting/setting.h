#pragma once
// Makes the metal that holds a stone: prongs or a bezel, their gallery, and a ring's shank.

#include <optional>
#include <string>
#include <vector>

#include "stone/setting/shell.h"
#include "stone/solid/solid.h"

namespace culet {

enum class SettingStyle { prong, bezel };

/// Lengths in the stone's unit. Defaults follow from W, the girdle's narrowest extent.
struct SettingOptions {
    SettingStyle style = SettingStyle::prong;
    int prongs = 0;                        ///< 0: as many as the outline needs, one at every corner
    std::optional<double> prong_diameter;  ///< of the wire; default W / 8
    std::optional<double> clearance;       ///< between metal and stone; default W / 500
    double ring_diameter = 17;             ///< inner, of the shank
    bool shank = true;
    int smoothness = 24;  ///< flat sides of a round wire, a multiple of 4, at least 8
};

/// One closed shell of the mounting. Shells overlap where they are soldered together.
struct SettingPart {
    std::string name;  ///< prong1, ..., bezel, leg1, ..., gallery1, ..., shank
    Shell shell;
    double gap = 0;  ///< least distance from the stone; the wire's diameter if it is further off
                     ///< than that
};

struct Setting {
    std::vector<SettingPart> parts;
    SettingOptions options;    ///< with all defaults filled in
    double girdle_height = 0;  ///< along up, of the outline that is held
    double clearance = 0;      ///< the least gap of all parts
    /// The plan's directions and up in the stone's frame, and the metal's bounds along them.
    Vec3 x{1, 0, 0}, y{0, 1, 0}, up{0, 0, 1};
    Vec3 low{0, 0, 0}, high{0, 0, 0};

    Vec3 in_frame_of_stone(const Vec3& v) const { return v.x * x + v.y * y + v.z * up; }
};

/// Makes the mounting of a stone whose table faces `up`. The shank's hoop is perpendicular to the
/// plan's x axis (stone/solid/caliper.h), so the stone lies along the finger. The outline may be
/// convex or notched.
/// - A prong is a round wire that rises from the gallery, leans against the girdle and bends over
///   it onto the crown. In its upright section it is the shortest path at a distance from all that
///   the wire may touch.
/// - A bezel is a collar of one section around the girdle's outline.
/// - Prongs, bezel and legs have the clearance as their gap, to within a thousandth of the wire's
///   diameter. Other metal is further off.
///
/// Shells are closed, counter-clockwise from outside, and not united. Throws InputError for lengths
/// that do not fit together and for stones without a girdle.
Setting make_setting(const Solid& solid, const Vec3& up, const SettingOptions& options);

/// Triangles have their part's name.
Solid mesh_of(const Setting& setting);

}  // namespace culet
