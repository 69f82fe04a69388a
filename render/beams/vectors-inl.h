// Vectors of numbers, points and directions, for many rays at once. No include guard: Highway
// includes this once per instruction set.

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

namespace culet {
struct Fragments;
}

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using V = hn::Vec<Floats>;
using M = hn::Mask<Floats>;
constexpr Floats k_floats;
constexpr int k_most_lanes = 64;

HWY_INLINE V number(float v) {
    return hn::Set(k_floats, v);
}
/// exp of a non-positive number. The result is 0 below -104; there the library's powers of two
/// overflow and set the invalid-operation flag, hence the clamp.
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

// Derivatives of a value per pixel, to the right and down.
struct Gradient {
    V x, y;
};
// A ray with its derivatives per pixel.
struct Ray {
    V3 point, direction, point_x, point_y, direction_x, direction_y;
    const Fragments* parts = nullptr;  // the fragments of these rays, from `first` on
    int first = 0;
};

// A parallelogram in a pixel (CoveredPixels): changes along its sides of a quantity that changes by
// `right` and `down` per pixel.
struct PixelPart {
    V xx, yx, yy;
    HWY_INLINE V3 along(const V3& right, const V3& down) const {
        return plus(xx * right, yx, down);
    }
    HWY_INLINE V3 across(const V3& down) const { return yy * down; }
};

// Share of a pixel where a linear value is positive.
HWY_INLINE V share_above(const V& value, const Gradient& g) {
    const V a = hn::Abs(g.x), b = hn::Abs(g.y);
    const V high = hn::Max(hn::Max(a, b), number(1e-15f)), low = hn::Min(a, b);
    const V size = hn::Abs(value), reach = number(0.5f) * (high + low);
    // The corner or slice of the pixel beyond the line.
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

// True if both changes per pixel are small against a distance.
HWY_INLINE M narrow(const V3& right, const V3& down, const V& distance) {
    return number(16.0f) * (dot(right, right) + dot(down, down)) < distance * distance;
}

// True if a change per pixel is not small against a circle's radius.
HWY_INLINE M exceeds(const V3& right, const V3& down, const V& radius) {
    return number(16.0f) * hn::Max(dot(right, right), dot(down, down)) > radius * radius;
}

// Share of a pixel's part that lies within a circle in the plane across `normal`. The part's middle
// is at `offset` from the circle's centre. Averages the circle's chords over the part's shorter
// side, as their middles and ends vary across it.
HWY_INLINE V share_in_disc(const V3& offset, const V3& right, const V3& down, const V3& normal,
                           const V& radius) {
    const V zero = number(0.0f), one = number(1.0f), half = number(0.5f);
    const M upright = dot(down, down) > dot(right, right);
    const auto choose = [&](const V3& a, const V3& b) HWY_ATTR {
        return V3{hn::IfThenElse(upright, a.x, b.x), hn::IfThenElse(upright, a.y, b.y),
                  hn::IfThenElse(upright, a.z, b.z)};
    };
    const V3 along = choose(down, right);
    V3 across = choose(right, down);
    const V length2 = hn::Max(dot(along, along), number(1e-30f));
    V area = dot(normal, cross(along, across));
    // Give a part without width a small one.
    constexpr float k_thin = 1e-4f;
    const M thin = hn::Abs(area) < number(k_thin) * length2;
    const V3 sideways = cross(normal, along);
    across = plus(across, hn::IfThenElseZero(thin, hn::CopySign(number(k_thin), area)), sideways);
    area = dot(normal, cross(along, across));
    area = hn::CopySign(hn::Max(hn::Abs(area), number(1e-34f)), area);
    // The circle's centre, in units of the part's sides.
    const V over = hn::Neg(one) / area;
    const V u = over * dot(normal, cross(offset, across)),
            v = over * dot(normal, cross(along, offset));
    const V high = radius * hn::Sqrt(length2) / hn::Abs(area);
    const V first = hn::Max(hn::Neg(half), v - high), last = hn::Min(half, v + high);
    const V filled = hn::Max(last - first, zero), rows = filled / high;
    const V from = hn::Clamp((first - v) / high, hn::Neg(one), one),
            to = hn::Clamp((last - v) / high, hn::Neg(one), one);
    const V middle = half * (from + to);
    // Mean of sqrt(1 - t^2): half a chord of the unit circle.
    const auto root = [&](const V& t)
                          HWY_ATTR { return hn::Sqrt(hn::Max(hn::NegMulAdd(t, t, one), zero)); };
    const auto integral = [&](const V& t) HWY_ATTR {
        return half * hn::MulAdd(t, root(t), hn::Asin(k_floats, t));
    };
    const V mean = hn::IfThenElse(rows > number(0.01f),
                                  (integral(to) - integral(from)) / hn::Max(rows, number(0.01f)),
                                  root(middle));
    const V reach = radius / hn::Sqrt(length2) * mean;
    const V chord = u - dot(along, across) / length2 * (middle * high);
    const V inside = hn::Min(chord + reach, half) - hn::Max(chord - reach, hn::Neg(half));
    return filled * hn::Max(inside, zero);
}

// Cosine and sine of twice the angle of a vector with components along and across.
struct DoubleAngle {
    V cosine, sine;
    HWY_INLINE DoubleAngle(const V& along, const V& across) {
        const V al = along * along, ac = across * across, length = al + ac;
        // Without a direction, any angle will do.
        const M any = length > number(1e-24f);
        const V scale = number(1.0f) / hn::IfThenElse(any, length, number(1.0f));
        cosine = hn::IfThenElse(any, (al - ac) * scale, number(1.0f));
        sine = hn::IfThenElseZero(any, (along + along) * across * scale);
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();
