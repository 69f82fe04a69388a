// What rays see of the lights. No include guard: Highway includes this once per instruction set.

#include <hwy/contrib/math/math-inl.h>

#include "render/beams/disc_in_part.h"

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

// Share of pixels' parts within a circle in the plane across `normal` (share_in_disc). For the rays
// of `some`, near enough to see the circle, uses the parts' corners if known.
HWY_INLINE V share_in_circle_by_parts(const Ray& ray, const M& some, const V3& offset,
                                      const V3& right, const V3& down, const V3& normal,
                                      const V& radius) {
    const V share = share_in_disc(offset, right, down, normal, radius);
    if (ray.parts == nullptr) return share;
    HWY_ALIGN float marks[k_most_lanes], shares[k_most_lanes], radii[k_most_lanes];
    HWY_ALIGN float numbers[4][3][k_most_lanes];
    hn::Store(hn::IfThenElseZero(some, number(1.0f)), k_floats, marks);
    hn::Store(share, k_floats, shares);
    hn::Store(radius, k_floats, radii);
    const V3* vectors[] = {&offset, &right, &down, &normal};
    for (int i = 0; i < 4; ++i) {
        hn::Store(vectors[i]->x, k_floats, numbers[i][0]);
        hn::Store(vectors[i]->y, k_floats, numbers[i][1]);
        hn::Store(vectors[i]->z, k_floats, numbers[i][2]);
    }
    const size_t lanes = hn::Lanes(k_floats);
    for (size_t lane = 0; lane < lanes; ++lane) {
        if (!(marks[lane] > 0)) continue;
        const auto at = [&](int i) {
            return Vec3{static_cast<double>(numbers[i][0][lane]),
                        static_cast<double>(numbers[i][1][lane]),
                        static_cast<double>(numbers[i][2][lane])};
        };
        const double exact =
            culet::share_in_disc(*ray.parts, ray.first + static_cast<int>(lane),
                                 {at(0), at(1), at(2), at(3), static_cast<double>(radii[lane])});
        if (exact >= 0) shares[lane] = static_cast<float>(exact);
    }
    return hn::Load(k_floats, shares);
}

// Share of a pixel that sees a distant disc around `axis`.
template <bool kSoft>
HWY_INLINE V disc_share(const ShadedLights::Disc& disc, const V3& axis, const Ray& ray) {
    const V3& d = ray.direction;
    const V cosine = dot(axis, d);
    if constexpr (!kSoft) return hn::IfThenElseZero(cosine > number(disc.cosine), number(1.0f));
    if (disc.cosine < -1) return number(1.0f);
    const Gradient wide{dot(axis, ray.direction_x), dot(axis, ray.direction_y)};
    const V share = share_above(cosine - number(disc.cosine), wide);
    if (disc.cosine < 0.70710678f) return share;
    // For small discs the cosine does not resolve the distance in single precision. Use the angle
    // to the rim, as 2 tan of its half: 2 (sin b - sin a) / (cos a + cos b). This fails where a
    // pixel sees so much that its part is no parallelogram (near total reflection).
    const M near_axis =
        hn::And(cosine > number(0.5f), narrow(ray.direction_x, ray.direction_y, number(1.0f)));
    if (hn::AllFalse(k_floats, near_axis)) return share;
    const V3& right = ray.direction_x;
    const V3& down = ray.direction_y;
    const V3 beside = plus(d, hn::Neg(cosine), axis);
    const V sine = length_of(beside), over = number(1.0f) / hn::Max(sine, number(1e-15f));
    const V inside = number(2.0f) * (number(disc.sine) - sine) / (cosine + number(disc.cosine));
    const Gradient near{dot(beside, right) * over, dot(beside, down) * over};
    V found = hn::IfThenElse(near_axis, share_above(inside, near), share);
    // Discs whose rim is visibly curved within a pixel.
    const V radius = number(2 * disc.sine / (1 + disc.cosine));
    const M small = hn::And(near_axis, exceeds(right, down, radius));
    if (hn::AllFalse(k_floats, small)) return found;
    found = hn::IfThenZeroElse(small, found);
    const V3 offset =
        number(2.0f) / (cosine + number(1.0f)) * plus(cosine * d, number(-1.0f), axis);
    const V reach = length_of(right) + length_of(down) + radius;
    const M met = hn::And(small, dot(offset, offset) < reach * reach);
    if (hn::AllFalse(k_floats, met)) return found;
    return hn::IfThenElse(met, share_in_circle_by_parts(ray, met, offset, right, down, d, radius),
                          found);
}

// Calls take(factor, radiance of each node, polarisation) for each distant light along a ray.
template <bool kSoft, class Take>
HWY_INLINE void distant_light(const ShadedLights& lights, const Ray& ray, const V& unhidden,
                              Take& take) {
    const V3& d = ray.direction;
    take(unhidden, lights.constant.data(), lights.surroundings);
    for (const ShadedLights::Lobe& lobe : lights.lobes) {
        const V cosine = hn::Max(
            hn::MulAdd(number(lobe.x), d.x, hn::MulAdd(number(lobe.y), d.y, number(lobe.z) * d.z)),
            number(0.0f));
        V power = number(1.0f);
        if (lobe.whole >= 0) {
            V square = cosine;
            for (int e = lobe.whole; e > 0; e >>= 1, square = square * square) {
                if (e & 1) power = power * square;
            }
            // Power 0 is 1 on the lobe's side only.
            if (lobe.whole == 0) power = hn::IfThenElseZero(cosine > number(0.0f), power);
        } else {
            // The smallest normal number replaces 0, whose logarithm is not finite.
            const V some = hn::Max(cosine, number(1.2e-38f));
            // Near the axis the cosine is 1 up to rounding, which a sharp lobe would amplify; the
            // sine keeps its digits.
            const V3 across = cross(V3{number(lobe.x), number(lobe.y), number(lobe.z)}, d);
            const V sine2 = hn::Min(dot(across, across), number(0.5f));
            const V logarithm = hn::IfThenElse(cosine > number(0.70710678f),
                                               number(0.5f) * hn::Log1p(k_floats, hn::Neg(sine2)),
                                               hn::Log(k_floats, some));
            power = hn::IfThenElseZero(cosine > number(0.0f),
                                       decayed(number(lobe.exponent) * logarithm));
        }
        take(unhidden * power, lobe.radiance.data(), lobe.polarised);
    }
    for (const ShadedLights::Cap& cap : lights.caps) {
        const V3 axis{number(cap.x), number(cap.y), number(cap.z)};
        V share = disc_share<kSoft>(cap.outer, axis, ray);
        if (cap.inner.cosine <= 1) share = share - disc_share<kSoft>(cap.inner, axis, ray);
        take(unhidden * share, cap.radiance.data(), cap.polarised);
    }
}

HWY_INLINE V3 environment_at(const EnvironmentPyramid& map, const V3& d, const V& extent) {
    const auto& levels = map.levels();
    const V sum = hn::Abs(d.x) + hn::Abs(d.y) + hn::Abs(d.z);
    const V scale = number(1.0f) / sum;
    const V px = d.x * scale, py = d.y * scale;
    const M below = d.z < number(0.0f);
    const V one = number(1.0f);
    const V fx = hn::CopySign(one - hn::Abs(py), px), fy = hn::CopySign(one - hn::Abs(px), py);
    const V u = hn::IfThenElse(below, fx, px), v = hn::IfThenElse(below, fy, py);
    // The level whose texels are about as large as what the pixel sees.
    const hn::Rebind<int32_t, Floats> ints;
    const V texels = hn::Max(extent / number(levels.front().texel), number(1.0f));
    // Nearest power of two: the exponent of sqrt(2) times it.
    const auto bits = hn::BitCast(ints, texels * number(1.41421356f));
    const auto level = hn::Min(hn::ShiftRight<23>(bits) - hn::Set(ints, 127),
                               hn::Set(ints, static_cast<int32_t>(levels.size()) - 1));
    HWY_ALIGN int32_t level_of[64], start_of[64], side_of[64];
    hn::Store(level, ints, level_of);
    const size_t lanes = hn::Lanes(k_floats);
    for (size_t i = 0; i < lanes; ++i) {
        const auto& here = levels[static_cast<size_t>(level_of[i])];
        start_of[i] = static_cast<int32_t>(here.start);
        side_of[i] = here.side;
    }
    const auto start = hn::Load(ints, start_of), side = hn::Load(ints, side_of);
    const V half = number(0.5f), side_f = hn::ConvertTo(k_floats, side);
    // Texel centres are at half-integers; the border adds 1.
    const V x = hn::MulAdd(hn::MulAdd(u, half, half), side_f, half),
            y = hn::MulAdd(hn::MulAdd(v, half, half), side_f, half);
    const V x0 = hn::Floor(x), y0 = hn::Floor(y);
    const V tx = x - x0, ty = y - y0;
    const auto row = side + hn::Set(ints, 2);
    const auto index = start + hn::ConvertTo(ints, y0) * row + hn::ConvertTo(ints, x0);
    const auto mix = [&](const float* plane) HWY_ATTR {
        const V a = hn::GatherIndex(k_floats, plane, index),
                b = hn::GatherIndex(k_floats, plane + 1, index),
                c = hn::GatherIndex(k_floats, plane, index + row),
                e = hn::GatherIndex(k_floats, plane + 1, index + row);
        const V upper = hn::MulAdd(tx, b - a, a), lower = hn::MulAdd(tx, e - c, c);
        return hn::MulAdd(ty, lower - upper, upper);
    };
    return {mix(map.plane(0)), mix(map.plane(1)), mix(map.plane(2))};
}

// Near lights: the share of the pixel that each fills, and its distance.
template <bool kSoft>
HWY_INLINE V sphere_share(const ShadedLights::Sphere& sphere, const Ray& ray, V& distance) {
    const V3 to{number(sphere.x) - ray.point.x, number(sphere.y) - ray.point.y,
                number(sphere.z) - ray.point.z};
    const V along = dot(to, ray.direction);
    const V3 beside = plus(to, hn::Neg(along), ray.direction);
    const V miss = hn::Sqrt(dot(beside, beside));
    const V radius = number(sphere.radius);
    distance = along;
    if constexpr (kSoft) {
        // Return early if no pixel is near it.
        const V wide = length_of(plus(ray.point_x, along, ray.direction_x)) +
                       length_of(plus(ray.point_y, along, ray.direction_y));
        if (hn::AllFalse(k_floats, miss < radius + wide)) return number(0.0f);
    }
    const V inside = radius - miss;
    const V half = hn::Sqrt(hn::Max(inside * (radius + miss), number(0.0f)));
    const V near = along - half, far = along + half;
    distance = hn::IfThenElse(near > number(0.0f), near, far);
    if constexpr (!kSoft) {
        return hn::IfThenElseZero(hn::And(distance > number(0.0f), inside > number(0.0f)),
                                  number(1.0f));
    } else {
        // Change per pixel of the point next to the centre, across the ray.
        const V over = number(1.0f) / hn::Max(miss, number(1e-30f));
        const V3 to_right = plus(ray.point_x, along, ray.direction_x),
                 down = plus(ray.point_y, along, ray.direction_y);
        const Gradient g{dot(beside, to_right) * over, dot(beside, down) * over};
        V share = share_above(inside, g);
        const M small = exceeds(to_right, down, radius);
        if (!hn::AllFalse(k_floats, small)) {
            const auto level = [&](const V3& v) HWY_ATTR {
                return plus(v, hn::Neg(dot(ray.direction, v)), ray.direction);
            };
            const V reach = length_of(to_right) + length_of(down) + radius;
            const M met = hn::And(small, miss < reach);
            share = hn::IfThenZeroElse(small, share);
            if (!hn::AllFalse(k_floats, met)) {
                share = hn::IfThenElse(
                    met,
                    share_in_circle_by_parts(ray, met, hn::Neg(number(1.0f)) * beside,
                                             level(to_right), level(down), ray.direction, radius),
                    share);
            }
        }
        return hn::IfThenElseZero(distance > number(0.0f), share);
    }
}

// Part of a lamp's greatest radiance along the rays that see any of it.
HWY_INLINE V lamp_share(const LampLight& lamp, const Ray& ray, const V& seen) {
    HWY_ALIGN float x[k_most_lanes], y[k_most_lanes], z[k_most_lanes], shares[k_most_lanes];
    hn::Store(ray.direction.x, k_floats, x);
    hn::Store(ray.direction.y, k_floats, y);
    hn::Store(ray.direction.z, k_floats, z);
    hn::Store(seen, k_floats, shares);
    const size_t lanes = hn::Lanes(k_floats);
    for (size_t i = 0; i < lanes; ++i) {
        if (!(shares[i] > 0)) continue;
        shares[i] =
            static_cast<float>(share_of(lamp, {static_cast<double>(x[i]), static_cast<double>(y[i]),
                                               static_cast<double>(z[i])}));
    }
    return hn::Load(k_floats, shares);
}

template <bool kSoft>
HWY_INLINE V plane_share(const ShadedLights::Plane& plane, const Ray& ray, V& distance) {
    const V3 normal{number(plane.x), number(plane.y), number(plane.z)};
    const V towards = dot(normal, ray.direction),
            height = dot(normal, ray.point) - number(plane.offset);
    const M meets = hn::And(towards<number(0.0f), height> number(0.0f));
    distance = height / hn::IfThenElse(meets, hn::Neg(towards), number(1.0f));
    V share = hn::IfThenElseZero(meets, number(1.0f));
    if (!plane.bounded || hn::AllFalse(k_floats, meets)) return share;
    const V3 at = plus(ray.point, distance, ray.direction);
    V3 at_x = at, at_y = at;
    if constexpr (kSoft) {
        const auto moved = [&](const V3& p, const V3& d) HWY_ATTR {
            const V3 still = plus(p, distance, d);
            return plus(still,
                        hn::Neg(dot(normal, still)) / hn::IfThenElse(meets, towards, number(-1.0f)),
                        ray.direction);
        };
        at_x = moved(ray.point_x, ray.direction_x);
        at_y = moved(ray.point_y, ray.direction_y);
    }
    for (const float* row : {plane.s, plane.t}) {
        const V3 axis = vector(row);
        const V value = dot(axis, at) + number(row[3]);
        Gradient g{number(0.0f), number(0.0f)};
        if constexpr (kSoft) g = {dot(axis, at_x), dot(axis, at_y)};
        share = share * (share_where<kSoft>(value + number(1.0f), g) -
                         share_where<kSoft>(value - number(1.0f), g));
        if (hn::AllFalse(k_floats, share > number(0.0f))) break;
    }
    return share;
}

// Adds near lights along a ray up to `reach`; returns the share of the pixel that they leave free.
template <bool kSoft, class Take>
HWY_INLINE V near_light(const ShadedLights& lights, const Ray& ray, const V& reach, Take& take) {
    V share[k_most_near_lights], distance[k_most_near_lights];
    const float* radiance[k_most_near_lights];
    const ShadedLights::Polarised* polarised[k_most_near_lights];
    const LampLight* lamp[k_most_near_lights];
    int count = 0;
    // Drop lights that no ray sees: of several lights most rays see one or none.
    const auto put = [&](const auto& light, const V& seen) HWY_ATTR {
        share[count] = hn::IfThenElseZero(distance[count] < reach, hn::Max(seen, number(0.0f)));
        if (hn::AllFalse(k_floats, share[count] > number(0.0f))) return;
        radiance[count] = light.radiance.data();
        polarised[count] = &light.polarised;
        lamp[count] = nullptr;
        if constexpr (requires { light.lamp; }) lamp[count] = light.lamp.get();
        ++count;
    };
    for (const auto& sphere : lights.spheres)
        put(sphere, sphere_share<kSoft>(sphere, ray, distance[count]));
    for (const auto& plane : lights.planes)
        put(plane, plane_share<kSoft>(plane, ray, distance[count]));
    V unhidden = number(1.0f);
    for (int i = 0; i < count; ++i) {
        V seen = share[i];
        for (int j = 0; j < count; ++j) {
            if (j == i) continue;
            const M before = j < i ? distance[j] <= distance[i] : distance[j] < distance[i];
            seen = seen * (number(1.0f) - hn::IfThenElseZero(before, share[j]));
        }
        if (lamp[i] != nullptr) seen = seen * lamp_share(*lamp[i], ray, seen);
        take(seen, radiance[i], *polarised[i]);
        unhidden = unhidden * (number(1.0f) - share[i]);
    }
    return unhidden;
}

template <bool kSoft, class Take>
HWY_INLINE void all_light(const ShadedLights& lights, const Ray& ray, Take& take) {
    V unhidden = number(1.0f);
    if (!lights.spheres.empty() || !lights.planes.empty())
        unhidden = near_light<kSoft>(lights, ray, number(3e38f), take);
    distant_light<kSoft>(lights, ray, unhidden, take);
    if (lights.environment) {
        V extent = number(0.0f);
        if constexpr (kSoft)
            extent = hn::Max(length_of(ray.direction_x), length_of(ray.direction_y));
        const V3 rgb = environment_at(*lights.environment, ray.direction, extent);
        take.colour(unhidden * rgb.x, unhidden * rgb.y, unhidden * rgb.z, lights.surroundings);
    }
}

// The end of a path as the eye sees it: its weight at each node and, if polarisation matters (with
// one node), the other Stokes parameters along u and v.
struct PathWeight {
    const V* weight;
    bool polarised = false;
    V Q, U;  // relative to I = weight[0]
    V3 direction, u, v;
};

// Adds light to the nodes' sums; without `kMany` there is one node and no absorption.
template <bool kMany>
struct Gather {
    const ShadedLights& lights;
    V* sum;
    const PathWeight& path;

    HWY_INLINE int nodes() const { return kMany ? lights.nodes : 1; }

    // Weight of the path for a polarised light.
    HWY_INLINE V weight(int node, const ShadedLights::Polarised& light) const {
        const V I = path.weight[node];
        if (!kMany || !path.polarised || light.degree == 0) return I;
        V3 along = vector(light.along);
        if (light.sheet) {
            V3 normal = vector(light.normal);
            const V sign = hn::CopySign(number(1.0f), dot(normal, path.direction));
            normal = sign * normal;
            // Turned with the normal into the ray, and so perpendicular to it.
            const V cosine = dot(normal, path.direction);
            along = plus(along, hn::Neg(dot(along, path.direction)) / (number(1.0f) + cosine),
                         normal + path.direction);
        }
        const V a = dot(along, path.u), b = dot(along, path.v);
        const V square = hn::Max(hn::MulAdd(a, a, b * b), number(1e-30f));
        const V Q = (a * a - b * b) / square, U = number(2.0f) * a * b / square;
        return hn::MulAdd(number(light.degree), hn::MulAdd(path.Q, Q, path.U * U), I);
    }

    HWY_INLINE void operator()(const V& factor, const float* radiance,
                               const ShadedLights::Polarised& light) const {
        for (int i = 0; i < nodes(); ++i)
            sum[i] = hn::MulAdd(factor * weight(i, light), number(radiance[i]), sum[i]);
    }
    HWY_INLINE void colour(const V& r, const V& g, const V& b,
                           const ShadedLights::Polarised& light) const {
        const V more_red = r - g, more_blue = b - g;
        for (int i = 0; i < nodes(); ++i) {
            const auto at = static_cast<size_t>(i);
            const V seen = hn::MulAdd(more_red, number(lights.red[at]),
                                      hn::MulAdd(more_blue, number(lights.blue[at]), g));
            sum[i] = hn::MulAdd(weight(i, light), seen, sum[i]);
        }
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();
