// EnvironmentMap::at for a lat-long map, vectorised in single precision. No include guard: Highway
// includes this once per instruction set.

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

using Ints = hn::Rebind<std::int32_t, Floats>;
constexpr Ints k_ints;

// Angle of the vector (along, across) with across >= 0, in 0 .. pi.
HWY_INLINE V angle_of(const V& along, const V& across) {
    const V size = hn::Abs(along);
    const V low = hn::Min(size, across), high = hn::Max(size, across);
    const V small = hn::Atan(k_floats, low / hn::Max(high, number(1e-30f)));
    const V acute = hn::IfThenElse(across > size, number(1.57079633f) - small, small);
    return hn::IfThenElse(along < number(0.0f), number(3.14159265f) - acute, acute);
}

// Adds EnvironmentMap::at to the sums of kNodes nodes; `kNodes` 0: all.
template <int kNodes>
HWY_INLINE void environment_light(const ExitLights& lights, const V3& d, const V& unhidden,
                                  V* sum) {
    const EnvironmentMap& map = *lights.environment;
    const V zero = number(0.0f), half = number(0.5f);
    const V azimuth = hn::CopySign(angle_of(d.x, hn::Abs(d.y)), d.y);
    const V polar = angle_of(d.z, hn::Sqrt(hn::MulAdd(d.x, d.x, d.y * d.y)));
    const float width = static_cast<float>(map.width), height = static_cast<float>(map.height);
    const V x = hn::NegMulAdd(azimuth, number(width * 0.159154943f), number(0.5f * width)) - half;
    const V y = hn::Clamp(polar * number(height * 0.318309886f) - half, zero, number(height - 1));
    const V x0 = hn::Floor(x), y0 = hn::Floor(y);
    const V tx = x - x0, ty = y - y0;
    const auto wide = hn::Set(k_ints, map.width), one = hn::Set(k_ints, 1);
    const auto wrapped = [&](hn::Vec<Ints> column) HWY_ATTR {
        column = hn::IfThenElse(column < hn::Zero(k_ints), column + wide, column);
        return hn::IfThenElse(wide > column, column, column - wide);
    };
    const auto left = wrapped(hn::ConvertTo(k_ints, x0));
    const auto right = wrapped(hn::ConvertTo(k_ints, x0) + one);
    const auto upper = hn::ConvertTo(k_ints, y0);
    const auto lower = hn::Min(upper + one, hn::Set(k_ints, map.height - 1));
    const auto texel = [&](const hn::Vec<Ints>& column, const hn::Vec<Ints>& row)
                           HWY_ATTR { return hn::Set(k_ints, 3) * (row * wide + column); };
    const auto a = texel(left, upper), b = texel(right, upper), c = texel(left, lower),
               e = texel(right, lower);
    V rgb[3];
    for (int channel = 0; channel < 3; ++channel) {
        const float* plane = map.rgb.data() + channel;
        const V p = hn::GatherIndex(k_floats, plane, a), q = hn::GatherIndex(k_floats, plane, b),
                r = hn::GatherIndex(k_floats, plane, c), s = hn::GatherIndex(k_floats, plane, e);
        const V top = hn::MulAdd(tx, q - p, p), bottom = hn::MulAdd(tx, s - r, r);
        rgb[channel] = unhidden * hn::MulAdd(ty, bottom - top, top);
    }
    const V more_red = rgb[0] - rgb[1], more_blue = rgb[2] - rgb[1];
    const int nodes = kNodes > 0 ? kNodes : lights.nodes;
    for (int i = 0; i < nodes; ++i) {
        const auto at = static_cast<size_t>(i);
        sum[i] = sum[i] + hn::MulAdd(more_red, number(lights.red[at]),
                                     hn::MulAdd(more_blue, number(lights.blue[at]), rgb[1]));
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();
