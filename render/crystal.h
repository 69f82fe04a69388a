#pragma once
// Waves in a crystal, and what a face does to them.
//
// Fields ~ exp(i k0 N.r - i w t), H = N x E, D = eps E, mu = 1. A mode has a wave normal along N,
// which obeys Snell's law, and a ray along the Poynting vector S = Re(E x H*), which is where its
// light goes. Formulas: Born & Wolf, Principles of Optics, chapter 15; Beyerle & McDermid 1998 for
// the uniaxial face.

#include <array>
#include <complex>

#include "stone/solid.h"

namespace culet {

struct ComplexVec3 {
    std::complex<double> x, y, z;
};

/// A uniaxial crystal at one wavelength.
struct UniaxialCrystal {
    Vec3 axis{0, 0, 1};           ///< unit optic axis
    double n_o = 1.5, n_e = 1.5;  ///< principal indices
};

enum class ModeKind { ordinary, extraordinary };

/// One plane wave. The field's scale is arbitrary: powers are ratios of normal fluxes.
struct CrystalMode {
    ModeKind kind = ModeKind::ordinary;
    bool propagates = true;  ///< false: evanescent, carries no power away from the face
    ComplexVec3 E, H;
    Vec3 wave{0, 0, 0};  ///< N, when it propagates
    Vec3 ray{0, 0, 0};   ///< unit S, when it propagates
    double flux = 0;     ///< |S|
};

/// The o and the e wave of tangential wave vector K at a face of unit normal n that carry energy
/// (or decay) towards +n. Near N parallel to the axis the two have the same N and any two
/// directions serve.
std::array<CrystalMode, 2> modes_towards(const UniaxialCrystal& crystal, const Vec3& K,
                                         const Vec3& n);

/// Light from an isotropic medium enters: powers, as fractions of the incident normal flux.
struct CrystalEntry {
    std::array<CrystalMode, 2> modes;
    std::array<std::array<double, 2>, 2> power{};  ///< [incident s, p][mode]
    std::array<double, 2> reflected{};             ///< [incident s, p]
    double imbalance = 0;  ///< |sum - 1| before the powers were renormalised
};
/// `n_into`: unit normal that points into the crystal; K: tangential wave vector, |K| <= n_outside.
CrystalEntry enter_crystal(const UniaxialCrystal& crystal, double n_outside, const Vec3& K,
                           const Vec3& n_into);

/// A mode meets a face from inside.
struct CrystalHit {
    std::array<CrystalMode, 2> modes;  ///< reflected
    std::array<double, 2> power{};     ///< of them, fractions of the incident normal flux
    double transmitted = 0;            ///< fraction that leaves
    Vec3 exit_direction{0, 0, 0};      ///< unit; meaningful when transmitted > 0
    double imbalance = 0;              ///< |sum - 1| before the powers were renormalised
};
/// `n_out`: unit outward normal; the incident mode's ray must run towards it.
CrystalHit hit_face(const UniaxialCrystal& crystal, double n_outside, const CrystalMode& incident,
                    const Vec3& n_out);

/// Napierian absorption of intensity per length along the ray, from the principal coefficients,
/// exact to first order in absorption per wavelength: sum_i n_i K_i |E_i|^2 / |S|.
double absorption_along(const UniaxialCrystal& crystal, const CrystalMode& mode, double k_o,
                        double k_e);

}  // namespace culet
