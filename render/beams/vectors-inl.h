// Vectors of numbers, and of points and directions, many rays at once.
// For one instruction set; Highway includes this once for each, which a guard of the usual kind
// would not let it.

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using V = hn::Vec<Floats>;
using M = hn::Mask<Floats>;
constexpr Floats k_floats;

HWY_INLINE V number(float v) {
    return hn::Set(k_floats, v);
}
/// e to the power of what is not positive. From -104 on the library gives 0 but computes with
/// powers of two beyond its numbers on the way, which sets the flag of an invalid operation.
HWY_INLINE V decayed(V v) {
    return hn::Exp(k_floats, hn::Max(v, number(-105.0f)));
}
HWY_INLINE V clamped_to_unit(V v) {
    return hn::Min(hn::Max(v, number(0.0f)), number(1.0f));
}

struct V3 {
    V x, y, z;
};
HWY_INLINE V3 vector(const float* v) {
    return {number(v[0]), number(v[1]), number(v[2])};
}
HWY_INLINE V3 operator+(const V3& a, const V3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE V3 operator*(const V& f, const V3& a) {
    return {f * a.x, f * a.y, f * a.z};
}
// a + f b
HWY_INLINE V3 plus(const V3& a, const V& f, const V3& b) {
    return {hn::MulAdd(f, b.x, a.x), hn::MulAdd(f, b.y, a.y), hn::MulAdd(f, b.z, a.z)};
}
HWY_INLINE V dot(const V3& a, const V3& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, a.z * b.z));
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE V length_of(const V3& a) {
    return hn::Sqrt(dot(a, a));
}

// How a value changes from pixel to pixel: to the right and down.
struct Gradient {
    V x, y;
};
// A ray, and how it changes from pixel to pixel.
struct Ray {
    V3 point, direction, point_x, point_y, direction_x, direction_y;
};

// A parallelogram in a pixel, as CoveredPixels has it: how far its sides take what changes by
// `right` and `down` from pixel to pixel.
struct PixelPart {
    V xx, yx, yy;
    HWY_INLINE V3 along(const V3& right, const V3& down) const {
        return plus(xx * right, yx, down);
    }
    HWY_INLINE V3 across(const V3& down) const { return yy * down; }
};

// Share of a pixel where a value that is linear in it is above 0.
HWY_INLINE V share_above(const V& value, const Gradient& g) {
    const V a = hn::Abs(g.x), b = hn::Abs(g.y);
    const V high = hn::Max(hn::Max(a, b), number(1e-15f)), low = hn::Min(a, b);
    const V size = hn::Abs(value), reach = number(0.5f) * (high + low);
    // The pixel's corner beyond the line, or a slice of it.
    const V missing = hn::Max(reach - size, number(0.0f));
    const V corner = missing * missing / (number(2.0f) * high * hn::Max(low, number(1e-15f)));
    const V slice = number(0.5f) - size / high;
    const V beyond = hn::IfThenElse(size < number(0.5f) * (high - low), slice, corner);
    return hn::IfThenElse(value > number(0.0f), number(1.0f) - beyond, beyond);
}

template <bool kSoft>
HWY_INLINE V share_where(const V& value, const Gradient& g) {
    if constexpr (kSoft) {
        return share_above(value, g);
    } else {
        (void)g;
        return hn::IfThenElseZero(value > number(0.0f), number(1.0f));
    }
}

// True where two changes from pixel to pixel are small against a distance.
HWY_INLINE M narrow(const V3& right, const V3& down, const V& distance) {
    return number(16.0f) * (dot(right, right) + dot(down, down)) < distance * distance;
}

// Cosine and sine of twice an angle from a vector along and across.
struct DoubleAngle {
    V cosine, sine;
    HWY_INLINE DoubleAngle(const V& along, const V& across) {
        const V al = along * along, ac = across * across, length = al + ac;
        // Where there is no direction all serve.
        const M any = length > number(1e-24f);
        const V scale = number(1.0f) / hn::IfThenElse(any, length, number(1.0f));
        cosine = hn::IfThenElse(any, (al - ac) * scale, number(1.0f));
        sine = hn::IfThenElseZero(any, (along + along) * across * scale);
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();
