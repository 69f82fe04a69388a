#include "render/beams/beam_forms.h"
#include "render/optics/band.h"
#include "render/setup/built_effects.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/beams/soft_polarised_beam.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h and in this order, each needing the one before.
// clang-format off
#include "render/beams/vectors-inl.h"
#include "render/beams/lights-inl.h"
#include "render/beams/crystal-inl.h"
#include "render/beams/follower-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

void ShadeSoftPolarisedBeam(const ShadingJob& job, const ShadedEye& eye,
                            const std::uint16_t* facets, int facet_count,
                            const Fragments& fragments) {
    if constexpr (k_has_effects) {
        follow_beam<true, true>(job, eye, facets, facet_count, fragments);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace culet {

HWY_EXPORT(ShadeSoftPolarisedBeam);

void shade_soft_polarised_beam(const ShadingJob& job, const ShadedEye& eye,
                               const std::uint16_t* facets, int facet_count,
                               const Fragments& fragments) {
    HWY_DYNAMIC_DISPATCH(ShadeSoftPolarisedBeam)(job, eye, facets, facet_count, fragments);
}

}  // namespace culet
#endif
