#pragma once
// The two waves of a biaxial crystal at a face: where no formula in closed form exists.

#include "render/optics/crystal.h"

namespace culet {

/// As modes_towards, [0] the slow and [1] the fast wave. Along an optic axis the two coincide and
/// any pair of vibrations serves. Fresnel's equation is solved in w = N^2 - n2^2, whose terms are
/// all of the order of the birefringence, so that nothing cancels however small it is. Cost: some
/// five steps a wave; near grazing, and where a wave is evanescent, the eigenvalues of a 4x4
/// matrix.
std::array<CrystalMode, 2> biaxial_modes(const Crystal::Rising& crystal, const Vec3& K,
                                         const Vec3& n);

/// Fill in the fields of a mode from E, scaled to length 1, and N. A travelling wave's are real.
void complete_travelling(CrystalMode& mode, const Vec3& E, const Vec3& N);
void complete_evanescent(CrystalMode& mode, const ComplexVec3& E, const ComplexVec3& N);

/// Next to an optic axis the last digit of N turns a wave's fields through any angle, and the two
/// waves of one K, found one by one, would no longer be independent: powers would not add up. This
/// turns the second's vibration about its N until they share no flux along n, Re(E1 x H2* + E2* x
/// H1).n = 0, as two travelling waves of one K and different q do. `E_beside`: the field of the
/// vibration at right angles, eps^-1 H of the second.
void share_no_flux(const CrystalMode& first, CrystalMode& second, const Vec3& E_beside,
                   const Vec3& n);

}  // namespace culet
