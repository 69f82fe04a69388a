#pragma once
#include <optional>
#include "render/convex_body.h"
namespace culet {
class PolyhedronBody {
public:
    explicit PolyhedronBody(const Solid& solid);
    std::optional<BodyHit> entry(const Vec3& origin, const Vec3& direction) const;
    BodyHit exit(const Vec3& origin, const Vec3& direction, int from) const;
    std::optional<BodyHit> reentry(const Vec3& origin, const Vec3& direction, int from) const;
    bool contains(const Vec3& point) const;
};
}  // namespace culet
