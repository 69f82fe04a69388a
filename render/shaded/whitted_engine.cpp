// The engine "whitted".

#include "render/engine/engine.h"
#include "render/shaded/shaded_picture.h"
#include "render/shaded/whitted.h"

namespace culet {

namespace {

constexpr double k_ns_per_face = 600;
// Depth if the scene leaves it open: later light is dim.
constexpr int k_usual_depth = 10;

class WhittedEngine : public Engine {
public:
    std::string name() const override { return "whitted"; }
    std::string refuses(const Scene& scene, const OpticalSetup&) const override {
        return refused_by_shading(scene);
    }
    double cost_ns(const DrawingWork& work) const override {
        return k_ns_per_face * work.pixels * work.views * work.bands * work.faces_per_ray;
    }
    bool approaches_truth() const override { return false; }

    RenderResult draw(const Scene& scene, const Progress& progress) const override {
        require_shadable(scene);
        const int depth = scene.settings.depth > 0 ? scene.settings.depth : k_usual_depth;
        const WhittedTracer tracer(scene, depth);
        RenderResult result = shaded_picture(
            scene, name(),
            [&](const EyeRay& ray, std::uint64_t number) {
                const WhittedTracer::Seen seen = tracer.trace(ray, number);
                return SeenColour{seen.colour, seen.met};
            },
            progress);
        result.stats.depth = depth;
        return result;
    }
};

}  // namespace

const Engine& whitted_engine() {
    static const WhittedEngine engine;
    return engine;
}

}  // namespace culet
