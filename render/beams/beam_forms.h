#pragma once
// shade_beam (beam_shading.h) for sharp light edges and for edges averaged over a pixel. Each has
// its own file, as it takes the compiler half a minute.

#include "render/beams/beam_shading.h"
#include "render/setup/built_effects.h"

namespace culet {

/// Whether polarisation is carried along; false in builds without it.
inline bool polarised(const ShadingJob& job) {
    return k_has_effects && (job.optics->polarised || job.optics->crystal || job.optics->response);
}

void shade_sharp_beam(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                      int facet_count, const Fragments& fragments);
void shade_soft_beam(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                     int facet_count, const Fragments& fragments);
void shade_soft_polarised_beam(const ShadingJob& job, const ShadedEye& eye,
                               const std::uint16_t* facets, int facet_count,
                               const Fragments& fragments);

}  // namespace culet
