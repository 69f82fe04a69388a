#pragma once
// Waves in a crystal, and their reflection and refraction at faces.
//
// Fields ~ exp(i k0 N.r - i w t), H = N x E, D = eps E, mu = 1. A mode's wave normal is along N,
// which obeys Snell's law; its light travels along the ray, the Poynting vector S = Re(E x H*). At
// a face of normal n every wave has the same tangential part K of N; s = K x n / |K| and p = N/|N|
// x s. Amplitudes at a face are in units of the root of normal flux |S.n|, so powers are their
// squares and a face is a unitary matrix. Formulas: Born & Wolf, Principles of Optics, chapter 15;
// Beyerle & McDermid 1998 for the uniaxial face.

#include <array>
#include <complex>

#include "stone/solid/solid.h"

namespace culet {

using Complex = std::complex<double>;

struct ComplexVec3 {
    Complex x, y, z;
};

enum class ModeKind : char { ordinary = 'o', extraordinary = 'e', slow = 's', fast = 'f' };

/// A crystal of any optical class at one wavelength. Principal indices equal to the last bit make
/// it uniaxial or isotropic. An isotropic one still has two modes, of one N.
class Crystal {
public:
    /// `axes`: orthonormal; `n`: index of light that vibrates along each.
    Crystal(const std::array<Vec3, 3>& axes, const std::array<double, 3>& n);
    Crystal() : Crystal({Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {1.5, 1.5, 1.5}) {}

    bool biaxial() const { return biaxial_; }
    bool isotropic() const { return !biaxial_ && n_o_ == n_e_; }
    /// Uniaxial: the optic axis.
    const Vec3& axis() const { return axis_; }
    double n_o() const { return n_o_; }
    double n_e() const { return n_e_; }
    const std::array<Vec3, 3>& axes() const { return axes_; }
    const std::array<double, 3>& n() const { return n_; }

    /// Biaxial: principal axes by rising index. e2 = n2^2, d1 = n1^2 - n2^2 < 0, d3 = n3^2 - n2^2.
    struct Rising {
        std::array<Vec3, 3> axes;
        std::array<double, 3> n;
        double e1 = 0, e2 = 0, e3 = 0, d1 = 0, d3 = 0;
    };
    const Rising& rising() const { return rising_; }

private:
    std::array<Vec3, 3> axes_;
    std::array<double, 3> n_;
    bool biaxial_ = false;
    Vec3 axis_{0, 0, 1};
    double n_o_ = 1.5, n_e_ = 1.5;
    Rising rising_;
};

/// Uniaxial, from the unit optic axis.
Crystal uniaxial_crystal(const Vec3& axis, double n_o, double n_e);

/// One plane wave. The field's scale is arbitrary: powers are ratios of normal fluxes.
struct CrystalMode {
    ModeKind kind = ModeKind::ordinary;
    bool propagates = true;  ///< false: evanescent, carries no power away from the face
    ComplexVec3 E, H;
    Vec3 wave{0, 0, 0};  ///< N, when it propagates
    Vec3 ray{0, 0, 0};   ///< unit S, when it propagates
    double flux = 0;     ///< |S|
};

/// The two waves of tangential wave vector K at a face of unit normal n that carry energy (or
/// decay) towards +n: o and e, or slow and fast. If both have the same N (along an optic axis, or
/// isotropic), their vibrations are arbitrary.
std::array<CrystalMode, 2> modes_towards(const Crystal& crystal, const Vec3& K, const Vec3& n);

/// Light from an isotropic medium enters the crystal, as s or p with unit normal flux.
struct CrystalEntry {
    std::array<CrystalMode, 2> modes;
    std::array<std::array<Complex, 2>, 2> into{};  ///< amplitudes [incident s, p][mode]
    std::array<std::array<Complex, 2>, 2> back{};  ///< amplitudes [incident s, p][reflected s, p]
    std::array<std::array<double, 2>, 2> power{};  ///< |into|^2
    std::array<double, 2> reflected{};             ///< sum of |back|^2 over reflected s, p
    Vec3 s{0, 0, 0};                               ///< of the face
    double imbalance = 0;                          ///< |sum of powers - 1|, then normalised
};
/// `n_into`: unit normal that points into the crystal; K: tangential wave vector, |K| <= n_outside.
CrystalEntry enter_crystal(const Crystal& crystal, double n_outside, const Vec3& K,
                           const Vec3& n_into);

/// A mode of unit normal flux hits a face from inside.
struct CrystalHit {
    std::array<CrystalMode, 2> modes;    ///< reflected
    std::array<Complex, 2> amplitude{};  ///< of the reflected modes
    std::array<double, 2> power{};       ///< |amplitude|^2
    std::array<Complex, 2> out{};        ///< transmitted amplitudes, s and p
    double transmitted = 0;              ///< sum of |out|^2
    Vec3 exit_direction{0, 0, 0};        ///< unit; valid when transmitted > 0
    Vec3 s{0, 0, 0};                     ///< of the face
    double imbalance = 0;                ///< |sum of powers - 1|, then normalised
};
/// `n_out`: unit outward normal; the incident mode's ray must run towards it. `K`: tangential part
/// of its wave vector.
CrystalHit hit_face(const Crystal& crystal, double n_outside, const CrystalMode& incident,
                    const Vec3& K, const Vec3& n_out);
CrystalHit hit_face(const Crystal& crystal, double n_outside, const CrystalMode& incident,
                    const Vec3& n_out);

/// Part of each principal Napierian intensity coefficient K_i in the absorption per length along
/// the ray: alpha = sum_i share_i K_i with share_i = n_i |E_i|^2 / |S|, to first order in the
/// absorption per wavelength.
std::array<double, 3> absorption_shares(const Crystal& crystal, const CrystalMode& mode);

}  // namespace culet
