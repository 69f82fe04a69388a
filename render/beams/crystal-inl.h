// State carried along a path, and the effect of a crystal on it. No include guard: Highway includes
// this once per instruction set.

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

// Sum and difference of the powers of s and p, and twice the real and imaginary part of E_s E_p*
// (light_paths.h).
struct Carried {
    V I, Q, U, V_;

    // Rotates the frame by half the angle of (cosine, sine).
    HWY_INLINE void turn(const V& cosine, const V& sine) {
        const V before = Q;
        Q = hn::MulAdd(cosine, before, sine * U);
        U = hn::NegMulAdd(sine, before, cosine * U);
    }
};

HWY_INLINE V3 any_tangent(const V3& tangent, const V3& d, const M& oblique) {
    // Across the ray and the axis most nearly perpendicular to it.
    const V ax = hn::Abs(d.x), ay = hn::Abs(d.y), az = hn::Abs(d.z), zero = number(0.0f);
    const M x = hn::And(ax <= ay, ax <= az), y = hn::And(hn::Not(x), ay <= az);
    const V3 other{hn::IfThenElse(x, zero, hn::IfThenElse(y, d.z, hn::Neg(d.y))),
                   hn::IfThenElse(x, hn::Neg(d.z), hn::IfThenElse(y, zero, d.x)),
                   hn::IfThenElse(x, d.y, hn::IfThenElse(y, hn::Neg(d.x), zero))};
    return {hn::IfThenElse(oblique, tangent.x, other.x),
            hn::IfThenElse(oblique, tangent.y, other.y),
            hn::IfThenElse(oblique, tangent.z, other.z)};
}

// A segment of a crystal with merged waves: absorbs each wave, and reduces their coherence.
HWY_INLINE V go_through(const MergedCrystal& crystal, const V3& d, const V3& b, const V& length,
                        Carried& carried) {
    const V one = number(1.0f), half = number(0.5f), zero = number(0.0f);
    V along[2], across[2], cosine[2];
    for (int i = 0; i < 2; ++i) {
        const V3 axis = vector(crystal.optic_axis[i]);
        cosine[i] = dot(axis, d);
        along[i] = dot(b, axis) - cosine[i] * dot(d, b);
        across[i] = dot(d, cross(b, axis));
    }
    // Twice the bisector's angle is the sum of the two planes' angles.
    V c = along[0] * along[1] - across[0] * across[1],
      s = along[0] * across[1] + across[0] * along[1];
    const V size = hn::Sqrt(hn::MulAdd(c, c, s * s));
    const M any = size > number(1e-20f);
    const V scale = one / hn::IfThenElse(any, size, one);
    c = hn::IfThenElse(any, c * scale, one);
    s = hn::IfThenElseZero(any, s * scale);
    carried.turn(c, s);

    // Vibration directions of the waves: along and across the bisector.
    V3 tangent = cross(d, b);
    const V squared = dot(tangent, tangent);
    const M oblique = squared > number(1e-20f);
    // At normal incidence use any tangent; the angles above assume the same one.
    tangent = hn::AllTrue(k_floats, oblique) ? tangent : any_tangent(tangent, d, oblique);
    tangent = (one / length_of(tangent)) * tangent;
    const V3 beside = cross(d, tangent);
    const V cosine1 = hn::Sqrt(hn::Max(half * (one + c), zero));
    const V sine1 = hn::CopySign(hn::Sqrt(hn::Max(half * (one - c), zero)), s);
    const V3 first = cosine1 * tangent + sine1 * beside;
    const V3 second = cosine1 * beside + hn::Neg(sine1) * tangent;
    V alpha1 = zero, alpha2 = zero;
    for (int i = 0; i < 3; ++i) {
        const V3 axis = vector(crystal.principal[i]);
        const V p = dot(first, axis), q = dot(second, axis), K = number(crystal.absorption[i]);
        alpha1 = hn::MulAdd(K * p, p, alpha1);
        alpha2 = hn::MulAdd(K * q, q, alpha2);
    }
    const V way = hn::Max(length, zero);
    const V kept1 = decayed(hn::Neg(half * alpha1 * way)),
            kept2 = decayed(hn::Neg(half * alpha2 * way));
    const V power1 = half * (carried.I + carried.Q) * kept1 * kept1,
            power2 = half * (carried.I - carried.Q) * kept2 * kept2;
    const V absorbed = carried.I - power1 - power2;
    carried.I = power1 + power2;
    carried.Q = power1 - power2;
    if (crystal.waves_per_length == 0) {
        carried.U = carried.V_ = zero;
    } else {
        // 1/n^2 of the two waves, from the angles to the optic axes.
        const V sines =
            hn::Sqrt(hn::Max((one - cosine[0] * cosine[0]) * (one - cosine[1] * cosine[1]), zero));
        const V cosines = cosine[0] * cosine[1];
        const V mean = number(crystal.inverse_square[0]),
                spread = number(crystal.inverse_square[1]);
        const V fast = hn::MulAdd(spread, cosines + sines, mean),
                slow = hn::MulAdd(spread, cosines - sines, mean);
        // n_slow - n_fast without cancellation.
        const V root_fast = hn::Sqrt(fast), root_slow = hn::Sqrt(slow);
        const V split =
            number(2.0f) * spread * sines / (root_fast * root_slow * (root_fast + root_slow));
        const V retardation = split * way;
        const V turns = retardation * number(crystal.waves_per_length);
        const V phase = number(6.28318530718f) * (turns - hn::Round(turns));
        const V over = number(3.14159265359f) * retardation * number(crystal.coherence_per_length);
        const V sinc = hn::IfThenElse(over > number(1e-3f),
                                      hn::Sin(k_floats, over) / hn::Max(over, number(1e-3f)), one);
        const V left = hn::IfThenElseZero(over < number(3.14159265f), sinc * sinc) * kept1 * kept2;
        const V cos_phase = hn::Cos(k_floats, phase), sin_phase = hn::Sin(k_floats, phase);
        const V U = carried.U * left, W = carried.V_ * left;
        // E_first E_second*: the second, slow wave is ahead in phase.
        carried.U = hn::MulAdd(cos_phase, U, sin_phase * W);
        carried.V_ = hn::NegMulAdd(sin_phase, U, cos_phase * W);
    }
    carried.turn(c, hn::Neg(s));
    return absorbed;
}

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();
