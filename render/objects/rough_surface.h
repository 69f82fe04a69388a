#pragma once
// Scattering by rough surfaces: diffuse, or a metal's microfacets.

#include <optional>

#include "render/objects/surface.h"

namespace culet {

class RoughSurface {
public:
    /// `side`: the surface's normal on the visible side; `shading`: the normal used for scattering;
    /// `towards`: to the viewer. All unit.
    RoughSurface(const ReadySurface& surface, const Vec3& side, const Vec3& shading,
                 const Vec3& towards);

    bool reflects_to(const Vec3& direction) const;
    /// Common to all nodes, for a direction towards which the surface reflects.
    struct Spread {
        double factor = 0;
        double half_cosine = 1;  ///< of incidence on the microfacets that reflect there
    };
    Spread spread(const Vec3& direction) const;
    /// Reflected radiance per incident radiance and solid angle, including the cosine.
    double value(int node, const Spread& spread) const;
    /// Chooses a direction with `density` per solid angle; nothing if it points into the surface,
    /// where no light comes from.
    std::optional<Vec3> sample(Random& random) const;
    double density(const Vec3& direction) const;

private:
    Vec3 local(const Vec3& v) const;
    Vec3 global(const Vec3& v) const;
    const ReadySurface& surface_;
    Vec3 side_, x_, y_, z_;
    Vec3 towards_;     // in the surface's frame
    double once_ = 1;  // ReadySurface::reflected_once
};

}  // namespace culet
