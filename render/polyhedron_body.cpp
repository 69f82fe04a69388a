#include "render/polyhedron_body.h"
namespace culet {
PolyhedronBody::PolyhedronBody(const Solid&) {}
std::optional<BodyHit> PolyhedronBody::entry(const Vec3&, const Vec3&) const {
    return {};
}
BodyHit PolyhedronBody::exit(const Vec3&, const Vec3&, int) const {
    return {};
}
std::optional<BodyHit> PolyhedronBody::reentry(const Vec3&, const Vec3&, int) const {
    return {};
}
bool PolyhedronBody::contains(const Vec3&) const {
    return false;
}
}  // namespace culet
