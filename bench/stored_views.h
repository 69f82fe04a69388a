#pragma once
// Views around a stone at even steps of two angles, and those that surround a view between them
// (Lee 2004, chapter 6).

#include <array>
#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

struct StoredView {
    Camera camera;
    std::string name;  ///< of its table's file
    double share = 0;  ///< weight in the interpolated view; they add up to 1
};

/// The one to four stored views that surround that of `camera`: on the sphere around `look_at`
/// through it, at whole steps of the polar angle from +z and of the azimuth from +x, otherwise like
/// it. Steps are at most `step` radians and divide the range evenly. Throws InputError for a camera
/// with a lens, a conoscope, and where `up` is along such a view.
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
