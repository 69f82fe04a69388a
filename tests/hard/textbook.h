#pragma once
// Textbook methods in doubles, for comparison with culet's: correct on paper, but they lose digits
// in hard cases.

#include <array>
#include <complex>

#include "render/optics/crystal.h"
#include "stone/solid/solid.h"

namespace culet::hard {

/// Powers at a face of two isotropic media: R and T of s and p.
struct FacePowers {
    double R_s = 0, R_p = 0, T_s = 0, T_p = 0;
};
/// Snell as k = 1 - eta^2 (1 - c^2), Fresnel as differences over sums, T = 1 - R.
FacePowers textbook_face(double n1, double n2, double cosine);

/// Booker's quartic: det(N N^T - N^2 I + eps) = 0 expanded in q, N = K + q n. The four roots are
/// the eigenvalues of the companion matrix; vibrations are null vectors by cross products.
struct TextbookWave {
    std::complex<double> q;
    ComplexVec3 E;  ///< of length 1
};
std::array<TextbookWave, 4> textbook_waves(const std::array<Vec3, 3>& axes,
                                           const std::array<double, 3>& n, const Vec3& K,
                                           const Vec3& normal);

/// Makes a polygon mesh planar vertex by vertex: every corner moves to the mean of its projections
/// on the best planes of its facets, `sweeps` times.
void relax_vertices(Solid& solid, int sweeps);

}  // namespace culet::hard
