#pragma once
// The metal that holds a stone: prongs or a bezel, their gallery, and a ring's shank.

#include <optional>
#include <string>
#include <vector>

#include "stone/setting/shell.h"
#include "stone/solid/solid.h"

namespace culet {

enum class SettingStyle { prong, bezel };

/// Lengths in the stone's unit. What is not given follows from the width of the girdle, W: its
/// narrowest extent.
struct SettingOptions {
    SettingStyle style = SettingStyle::prong;
    int prongs = 0;  ///< 0: as many as the outline calls for, one at every corner
    std::optional<double> prong_diameter;  ///< of the wire; W / 8
    std::optional<double> clearance;       ///< between metal and stone; W / 500
    double ring_diameter = 17;             ///< inner, of the shank
    bool shank = true;
    int smoothness = 24;  ///< flat sides of a round wire, a multiple of 4, at least 8
};

/// One closed shell of the mounting. Shells overlap where they are soldered to each other.
struct SettingPart {
    std::string name;  ///< prong1, ..., bezel, leg1, ..., gallery1, ..., shank
    Shell shell;
    double gap = 0;  ///< least distance from the stone; of a part further off than a wire: that
};

struct Setting {
    std::vector<SettingPart> parts;
    SettingOptions options;    ///< with everything decided
    double girdle_height = 0;  ///< along up, of the section whose outline is held
    double clearance = 0;      ///< the least gap of all parts
    /// The plan's directions and up, in the stone's frame, and bounds of the metal along them.
    Vec3 x{1, 0, 0}, y{0, 1, 0}, up{0, 0, 1};
    Vec3 low{0, 0, 0}, high{0, 0, 0};

    Vec3 in_frame_of_stone(const Vec3& v) const { return v.x * x + v.y * y + v.z * up; }
};

/// The mounting of a stone that stands with its table along `up`; the shank's hoop runs across the
/// plan's x axis (stone/solid/caliper.h), so that a stone lies along the finger. Any convex or
/// notched outline will do.
///
/// - A prong is a round wire that rises from the gallery below, leans against the girdle and bends
///   over it onto the crown: in the upright section through its place the shortest path at a
///   distance from all that the wire may touch.
/// - A bezel is a collar of one section all round the girdle's outline.
/// - Prongs, bezel and legs are no nearer to the stone than the clearance, and come as near as that
///   to within a thousandth of the wire's diameter. All other metal is further off.
///
/// Each shell is closed and runs counter-clockwise as seen from outside; together they are not a
/// union. Throws InputError for lengths that do not go together and for stones without a girdle.
Setting make_setting(const Solid& solid, const Vec3& up, const SettingOptions& options);

/// All parts as one mesh of triangles that carry their part's name.
Solid mesh_of(const Setting& setting);

}  // namespace culet
