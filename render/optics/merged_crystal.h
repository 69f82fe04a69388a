#pragma once
// A crystal whose two waves share one path, for beams and GPUs.

#include "render/optics/band.h"

namespace culet {

/// Both waves follow the mean index (Guy & Soler 2004, 4.2); only polarisation is split. They
/// vibrate along the bisectors of the planes through the wave normal and the two optic axes (Biot
/// and Fresnel).
struct MergedCrystal {
    float optic_axis[2][3];          ///< unit vectors
    float inverse_square[2];         ///< half sum and half difference of 1/n^2, slow and fast
    float principal[3][3];           ///< axes of absorption
    float absorption[3];             ///< along each, per length
    float waves_per_length = 0;      ///< 1 / wavelength if the two waves stay coherent; else 0
    float coherence_per_length = 0;  ///< 1 / coherence length; 0: infinite
};

/// `band` must have two waves.
MergedCrystal merged_crystal(const Band& band, int node);

}  // namespace culet
