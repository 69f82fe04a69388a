#pragma once
// The light that exit events of a ray table see: vectorised in single precision if there are only
// lights around the stone, else asked of the surroundings one by one.

#include <memory>

#include "render/raytable/exit_lights.h"
#include "render/raytable/table_key.h"
#include "render/reference/surroundings.h"

namespace culet {

class ExitShader {
public:
    ExitShader() = default;
    ExitShader(const ExitShader&) = delete;
    ExitShader& operator=(const ExitShader&) = delete;
    virtual ~ExitShader() = default;

    /// As shade_exits and shade_rays, at the nodes of a band of the scene's setup.
    virtual double exits(std::size_t band, const ExitRun& run, float* radiance,
                         int stride) const = 0;
    virtual void rays(std::size_t band, const AirRays& rays, float* radiance, int stride) const = 0;
    /// Distance along the rays to the nearest thing that hides what lies behind it.
    virtual void nearest(const AirRays& rays, float* distance) const = 0;
    /// Origins of AirRays are relative to this point.
    virtual Vec3 middle() const = 0;
};

/// Which shader to use; tests compare them. Rays past the stone are single precision in both.
enum class ExitPrecision { fastest, double_precision };

/// `surroundings` and `table` must outlive it.
std::unique_ptr<const ExitShader> exit_shader(const Scene& scene, const TableRays& rays,
                                              const WavelengthSet& colours,
                                              const Surroundings& surroundings,
                                              const RayTable& table, ExitPrecision precision);

}  // namespace culet
