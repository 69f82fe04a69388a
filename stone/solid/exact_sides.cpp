#include "stone/solid/exact_sides.h"

#ifdef __wasm__
#include <CGAL/MP_Float.h>
#include <CGAL/Simple_cartesian.h>
#else
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif

#include <algorithm>

namespace culet {

namespace {

#ifdef __wasm__
// CGAL's filtered kernels use interval arithmetic, which needs directed rounding. WebAssembly only
// rounds to nearest, so every side is computed exactly from the start there.
using Kernel = CGAL::Simple_cartesian<CGAL::MP_Float>;
#else
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
#endif

Kernel::Point_3 point(const Vec3& p) {
    return {p.x, p.y, p.z};
}
Kernel::Point_2 point(const Vec2& p) {
    return {p.x, p.y};
}

// For p on the line through a and b.
bool lies_between(const Vec2& a, const Vec2& b, const Vec2& p) {
    return p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) && p.y >= std::min(a.y, b.y) &&
           p.y <= std::max(a.y, b.y);
}

}  // namespace

int side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return CGAL::orientation(point(a), point(b), point(c), point(d));
}

int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return CGAL::orientation(point(a), point(b), point(c));
}

bool segments_touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const int abc = turn(a, b, c), abd = turn(a, b, d);
    const int cda = turn(c, d, a), cdb = turn(c, d, b);
    if (abc * abd < 0 && cda * cdb < 0) return true;
    return (abc == 0 && lies_between(a, b, c)) || (abd == 0 && lies_between(a, b, d)) ||
           (cda == 0 && lies_between(c, d, a)) || (cdb == 0 && lies_between(c, d, b));
}

}  // namespace culet
