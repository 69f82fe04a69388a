#pragma once
// Light paths among objects and stones, traced backwards from where light is asked for: the light
// that arrives along a ray, as Stokes parameters. Path tracing (Kajiya 1986): polished surfaces and
// stones pass light on as Fresnel's equations have it, polarised; rough ones by one direction
// chosen at random and one aimed at the lights, weighted by both densities (Veach 1997, 9.2).

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

/// A scene made ready for one set of wavelengths. Does not change.
struct SceneWithObjects {
    SceneWithObjects(const Scene& scene, const WavelengthSet& wavelengths);

    ObjectWorld world;
    LightField lights;
    LightSampler sampler;
    std::vector<ReadySurface> surfaces;  ///< of the objects
    struct ReadyStone {
        OpticalSetup setup;
        PathLimits limits;
    };
    std::vector<ReadyStone> stones;  ///< as the world numbers them
    bool polarised_lights = false;
    int nodes = 1;
    double brightest = 0;
    double most_indirect = std::numeric_limits<double>::infinity();  ///< RenderSettings
    std::uint64_t seed = 1;
    /// Whole nanoseconds of price.h, so that their sum does not hang on the order of threads.
    mutable std::atomic<long long> spent_ns{0};
};

/// A ray that asks for light: `direction` leads away from who asks. Its light's Stokes parameters
/// count from `u`, `v`, orthonormal and normal to it.
struct WorldRay {
    Vec3 origin, direction, u, v;
    RayStart start;
    int medium = -1;        ///< the object of glass that it runs in
    int depth = 0;          ///< surfaces and stones met so far
    double importance = 1;  ///< largest share of its light that is used
};

/// Stokes parameters at the nodes of a range, counted from its first.
using ArrivingLight = std::array<NodeWeights, 4>;

/// Of the wavelengths `first` .. `first + count - 1`, at most k_band_nodes. `planes`: 1 (S0 alone,
/// everything taken as unpolarised) or 4.
class ObjectPaths {
public:
    ObjectPaths(const SceneWithObjects& scene, int first, int count, int planes, Random& random)
        : scene_(scene), first_(first), count_(count), planes_(planes), random_(random) {}
    ~ObjectPaths() { scene_.spent_ns += static_cast<long long>(spent_ns_); }
    ObjectPaths(const ObjectPaths&) = delete;
    ObjectPaths& operator=(const ObjectPaths&) = delete;

    void arriving(const WorldRay& ray, ArrivingLight& light);
    /// The same of a ray of less importance than `threshold` with a chance in proportion to it.
    /// Returns the factor that its light counts with; 0: it was not asked for.
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
    /// Adds what arrives along `next`, after the face that `face(node)` tells of, with its plane of
    /// incidence normal to `s`; `share`: of the light that goes this way, at most.
    template <class Face>
    void pass_on(const WorldRay& ray, WorldRay next, const Vec3& s, double share, double weight,
                 const Face& face, ArrivingLight& light);
    void absorb(const WorldRay& ray, double distance, ArrivingLight& light) const;
    void clear(ArrivingLight& light) const;
    /// Weight with which a ray of that importance goes on; 0: it does not.
    double roulette(const WorldRay& ray, double threshold);

    const SceneWithObjects& scene_;
    int first_, count_, planes_;
    Random& random_;
    double spent_ns_ = 0;
};

}  // namespace culet
