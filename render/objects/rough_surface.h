#pragma once
// How a surface that is not polished spreads light: diffuse, or microfacets of a metal.

#include <optional>

#include "render/objects/surface.h"

namespace culet {

class RoughSurface {
public:
    /// `side`: the surface's normal on the side that is seen; `shading`: that which light is spread
    /// about; `towards`: to who sees it. All unit.
    RoughSurface(const ReadySurface& surface, const Vec3& side, const Vec3& shading,
                 const Vec3& towards);

    bool reflects_to(const Vec3& direction) const;
    /// Radiance that is seen for one from `direction`, per solid angle: with the cosine. Of a
    /// direction that it reflects to.
    double value(int node, const Vec3& direction) const;
    /// A direction, chosen with `density` per solid angle; nothing: into the surface, where no
    /// light comes from.
    std::optional<Vec3> sample(Random& random) const;
    double density(const Vec3& direction) const;

private:
    Vec3 local(const Vec3& v) const;
    Vec3 global(const Vec3& v) const;
    const ReadySurface& surface_;
    Vec3 side_, x_, y_, z_;
    Vec3 towards_;  // in the surface's frame
};

}  // namespace culet
