#pragma once
// The parts of a mounting. Frame: that of a stone with z up.

#include <functional>
#include <vector>

#include "stone/setting/gap.h"
#include "stone/setting/places.h"
#include "stone/setting/setting.h"

namespace culet {

/// The common inputs of all parts.
struct SettingPlan {
    const Solid& solid;
    const StoneSurface& surface;
    const GirdleOutline& girdle;
    const GripOutline& grip;
    double wire = 0;        ///< diameter
    double clearance = 0;   ///< least distance from the stone
    int sides = 0;          ///< of a round wire
    PlanOutline base = {};  ///< centre line of the lowest rail of the gallery
    double base_height = 0;

    /// Distances above this need not be told apart.
    double far() const { return 4 * wire; }
};

/// The shell of `make` whose gap to the stone is the clearance, to within a thousandth of the wire.
/// Throws InputError, with `what`, if there is none.
Shell at_clearance(const SettingPlan& plan, const std::function<Shell(double)>& make,
                   const std::string& what);

/// A place, with the distance to the base against its outward direction. Where the outline's normal
/// misses the base (near sharp points), the direction is that to the base's middle.
struct FootedPlace {
    GirdlePlace place;
    double to_base = 0;
};
FootedPlace on_base(const SettingPlan& plan, GirdlePlace place);

struct Prong {
    Shell shell;
    GirdlePlace place;
    /// Below the girdle, in the section through the place.
    PlanPoint foot{0, 0}, shoulder{0, 0};
};

std::vector<Prong> make_prongs(const SettingPlan& plan, int count);

struct Bezel {
    Shell collar;
    std::vector<Shell> legs;  ///< from the collar to the base
};
Bezel make_bezel(const SettingPlan& plan);

/// A rail around all prongs between base and girdle, as high as possible; nothing where there is no
/// room.
std::optional<Shell> make_rail(const SettingPlan& plan, const std::vector<Prong>& prongs);

/// A point of the section through a place, in space.
inline Vec3 in_space(const GirdlePlace& place, const PlanPoint& point) {
    const PlanPoint plan = place.at + point.x * place.outward;
    return {plan.x, plan.y, point.y};
}

}  // namespace culet
