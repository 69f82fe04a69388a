#pragma once
// shade_beam (beam_shading.h) for lights whose edges are sharp, and for those that are averaged
// over a pixel: files of their own, because each is half a minute's work for the compiler.

#include "render/beams/beam_shading.h"
#include "render/setup/built_effects.h"

namespace culet {

/// Whether more than the intensity has to be carried along; never where polarisation is not built.
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
