#pragma once
// Views around a stone in even steps of two angles, and which of them lie about a view between
// (Lee 2004, chapter 6).

#include <array>
#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

struct StoredView {
    Camera camera;
    std::string name;  ///< of its table's file
    double share = 0;  ///< in the view between; of all together 1
};

/// The one to four views about that of `camera`: on the sphere around `look_at` on which it stands,
/// with its other numbers, at whole steps of the polar angle from +z and of the azimuth from +x.
/// Steps are `step` radians, or as much less as makes them even. Throws InputError for a camera
/// with a lens, a conoscope, and where `up` lies along such a view.
std::vector<StoredView> stored_views(const Camera& camera, double step);

/// Where a camera without a lens sees a point: pixels from the upper left corner.
class ScreenPlace {
public:
    explicit ScreenPlace(const Camera& camera);
    std::array<double, 2> of(const Vec3& point) const;

private:
    bool parallel_;
    Vec3 origin_, forward_, corner_, right_, down_;
};

}  // namespace culet
