#pragma once
// A second derivation of what a crystal face does to light, in 100 decimal digits, to check
// render/optics/crystal.h. It shares no formula with it:
//  - all four q of det(N N^T - N^2 I + eps) = 0, N = K + q n, as the roots of the quartic in q
//    whose coefficients come from expanding the determinant (Aberth's method);
//  - fields as null vectors of that matrix, H = N x E;
//  - towards +n by the sign of Re(E x H*).n where q is real, of Im q where not;
//  - amplitudes from the 4x4 system of continuous tangential E and H, with s and p waves outside
//    (evanescent ones included).
//
// Input: the doubles, with three repairs that make the problem physical and move no number by more
// than its own rounding error: n becomes a unit vector, K is projected on the face, and the axes
// become orthonormal (Gram-Schmidt, in their order).
//
// Precision: a double root of a quartic is found to 1e-50, one of a pair that is d apart to
// 1e-100/d, and the direction of its field to 1e-100/d^2. Waves closer than 1e-40 count as one,
// with two orthogonal fields in its plane of vibration.

#include <array>

#include "render/optics/crystal.h"

namespace culet::oracle {

struct Face {
    std::array<Vec3, 3> axes;
    std::array<double, 3> n;
    double n_outside = 1;
    Vec3 K{0, 0, 0};
    Vec3 normal{0, 0, 1};
    Vec3 s{0, 0, 0};  ///< used at |K| < 1e-13, where the face has no s of its own
};

/// A perturbation of the problem within the rounding of its input: K grows and turns about the
/// normal, the crystal turns.
struct Nudge {
    double K_growth = 0, K_turn = 0;
    Vec3 crystal_turn{0, 0, 0};
};

struct Wave {
    bool propagates = true;
    Complex q;
    ComplexVec3 N, E, H;  ///< unit normal flux when it propagates, else |E| = 1
    Vec3 ray{0, 0, 0};
    double flux_along_normal = 0;  ///< of E of unit length, signed
};

using Matrix2 = std::array<std::array<Complex, 2>, 2>;

/// Amplitudes in units of the square root of normal flux; waves without flux have amplitude 0.
struct Answer {
    std::array<Wave, 2> towards, away;  ///< from and to -n; uniaxial: o, e; biaxial: by falling N^2
    double gap_towards = 0, gap_away = 0;  ///< |q - q| of the two
    // Light from outside, n pointing into the crystal.
    bool enters = false;     ///< |K| < n_outside
    Matrix2 into{}, back{};  ///< [s, p incident][wave of `towards`], [reflected s, p]
    // A wave of `towards` from inside, n pointing out of the crystal.
    Matrix2 reflected{}, out{};  ///< [incident][wave of `away`], [s, p outside]
    double imbalance = 0;        ///< largest |sum of powers - 1| of the above
};

Answer solve(const Face& face, const Nudge& nudge = {});

/// |Im N| of the waves of a weakly absorbing crystal, per unit of `kappa`: principal indices
/// n_i + i kappa_i x, x -> 0.
struct Attenuation {
    std::array<double, 2> across_face;   ///< Im q of the waves towards n, with K real
    std::array<double, 2> along_normal;  ///< of homogeneous waves with the same wave normals
};
Attenuation attenuation(const Face& face, const std::array<double, 3>& kappa);

}  // namespace culet::oracle
