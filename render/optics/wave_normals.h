#pragma once
// The two waves of a biaxial crystal at a face, which have no closed formula.

#include "render/optics/crystal.h"

namespace culet {

/// Like modes_towards; [0] slow, [1] fast. Along an optic axis the two coincide and any pair of
/// vibrations serves. Fresnel's equation is solved in w = N^2 - n2^2, whose terms are all of the
/// order of the birefringence, so nothing cancels, however small it is. Cost: some five steps per
/// wave; near grazing and for evanescent waves, the eigenvalues of a 4x4 matrix.
std::array<CrystalMode, 2> biaxial_modes(const Crystal::Rising& crystal, const Vec3& K,
                                         const Vec3& n);

/// Compute a mode's fields from N and E, which they scale to length 1. A travelling wave's are
/// real.
void complete_travelling(CrystalMode& mode, const Vec3& E, const Vec3& N);
void complete_evanescent(CrystalMode& mode, const ComplexVec3& E, const ComplexVec3& N);

/// Restores the independence of two waves of one K next to an optic axis. There the last digit of N
/// turns a wave's fields by any angle, so that powers of waves found one by one would not add up.
/// Turns the second's vibration about its N until they share no flux along n, Re(E1 x H2* + E2* x
/// H1).n = 0, like two travelling waves of one K and different q. `E_beside`: field of the
/// perpendicular vibration, eps^-1 H of the second.
void share_no_flux(const CrystalMode& first, CrystalMode& second, const Vec3& E_beside,
                   const Vec3& n);

}  // namespace culet
