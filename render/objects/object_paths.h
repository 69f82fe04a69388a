#pragma once
// Light paths among objects and stones, traced backwards: the light that arrives along a ray, as
// Stokes parameters. It is path tracing (Kajiya 1986). Polished surfaces and stones pass on
// polarised light by Fresnel's equations. Rough surfaces take one random direction and one aimed at
// the lights, weighted by both densities (Veach 1997, 9.2).

#include <atomic>
#include <memory>
#include <vector>

#include "render/objects/light_sampler.h"
#include "render/objects/object_world.h"
#include "render/objects/surface.h"
#include "render/optics/path.h"
#include "render/reference/light_field.h"
#include "render/setup/optical_setup.h"

namespace culet {

/// A scene prepared for one set of wavelengths. Immutable, except for `spent_ns`.
struct SceneWithObjects {
    SceneWithObjects(const Scene& scene, const WavelengthSet& wavelengths);

    ObjectWorld world;
    LightField lights;
    LightSampler sampler;
    std::vector<ReadySurface> surfaces;  ///< per object
    struct ReadyStone {
        OpticalSetup setup;
        PathLimits limits;
    };
    std::vector<ReadyStone> stones;  ///< in the world's numbering
    bool polarised_lights = false;
    int nodes = 1;
    double brightest = 0;
    double most_indirect =
        std::numeric_limits<double>::infinity();  ///< RenderSettings::clamp_indirect
    std::uint64_t seed = 1;
    /// Nanoseconds of price.h, whole, so that the sum does not depend on the order of threads.
    mutable std::atomic<long long> spent_ns{0};
};

/// A ray that gathers light; `direction` leads away from the receiver. Stokes parameters of its
/// light refer to `u`, `v`, orthonormal and normal to it.
struct WorldRay {
    Vec3 origin, direction, u, v;
    RayStart start;
    int medium = -1;        ///< the glass object that it is in; -1: none
    int depth = 0;          ///< surfaces and stones hit so far
    double importance = 1;  ///< largest part of its light that is used
};

/// Stokes parameters at a range of nodes, indexed from its first.
using ArrivingLight = std::array<NodeWeights, 4>;

/// Traces the wavelengths `first` .. `first + count - 1`, at most k_band_nodes. `planes`: 1 (S0
/// only, all light taken as unpolarised) or 4.
class ObjectPaths {
public:
    ObjectPaths(const SceneWithObjects& scene, int first, int count, int planes, Random& random)
        : scene_(scene), first_(first), count_(count), planes_(planes), random_(random) {}
    ~ObjectPaths() { scene_.spent_ns += static_cast<long long>(spent_ns_); }
    ObjectPaths(const ObjectPaths&) = delete;
    ObjectPaths& operator=(const ObjectPaths&) = delete;

    void arriving(const WorldRay& ray, ArrivingLight& light);
    /// Follows a ray less important than `threshold` with proportional probability. Returns the
    /// weight of its light; 0: not followed.
    double arriving_if_it_matters(WorldRay ray, double threshold, ArrivingLight& light);

private:
    struct Meeting {
        WorldHit hit;
        double distance = 0;
        bool shines = false;  ///< a light, an emitter or the background
    };
    class StoneSink;

    Meeting meet(const WorldRay& ray);
    void shine(const WorldRay& ray, const Meeting& meeting, ArrivingLight& light) const;
    void answer(const WorldRay& ray, const WorldHit& hit, ArrivingLight& light);
    void scatter(const WorldRay& ray, const WorldHit& hit, ArrivingLight& light);
    void reflect(const WorldRay& ray, const WorldHit& hit, ArrivingLight& light);
    void refract(const WorldRay& ray, const WorldHit& hit, ArrivingLight& light);
    void through_stone(const WorldRay& ray, const WorldHit& hit, ArrivingLight& light);
    /// Adds the light along `next` after the face `face(node)`, with plane of incidence normal to
    /// `s`. `share`: largest part of the light that goes this way.
    template <class Face>
    void pass_on(const WorldRay& ray, WorldRay next, const Vec3& s, double share, double weight,
                 const Face& face, ArrivingLight& light);
    void absorb(const WorldRay& ray, double distance, ArrivingLight& light) const;
    void clear(ArrivingLight& light) const;
    /// Russian roulette: returns the weight of a ray that continues; 0: it ends.
    double roulette(const WorldRay& ray, double threshold);

    const SceneWithObjects& scene_;
    int first_, count_, planes_;
    Random& random_;
    double spent_ns_ = 0;
};

}  // namespace culet
