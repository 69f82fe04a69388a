// The engines "flat", "gouraud" and "phong".

#include "render/engine/engine.h"
#include "render/shaded/local_shading.h"
#include "render/shaded/shaded_picture.h"

namespace culet {

namespace {

constexpr double k_ns_per_ray = 400;

class LocalEngine : public Engine {
public:
    LocalEngine(const char* name, LocalShading shading) : name_(name), shading_(shading) {}

    std::string name() const override { return name_; }
    std::string refuses(const Scene& scene, const OpticalSetup&) const override {
        return refused_by_shading(scene);
    }
    double cost_ns(const DrawingWork& work) const override {
        return k_ns_per_ray * work.pixels * work.views * work.bands * work.faces_per_ray;
    }
    bool approaches_truth() const override { return false; }

    RenderResult draw(const Scene& scene, const Progress& progress) const override {
        require_shadable(scene);
        const LocalShader shader(scene, shading_);
        return shaded_picture(
            scene, name_,
            [&](const EyeRay& ray, std::uint64_t) {
                const LocalShader::Seen seen = shader.shade(ray);
                return SeenColour{seen.colour, seen.met};
            },
            progress);
    }

private:
    const char* name_;
    LocalShading shading_;
};

}  // namespace

const Engine& flat_engine() {
    static const LocalEngine engine("flat", LocalShading::flat);
    return engine;
}

const Engine& gouraud_engine() {
    static const LocalEngine engine("gouraud", LocalShading::gouraud);
    return engine;
}

const Engine& phong_engine() {
    static const LocalEngine engine("phong", LocalShading::phong);
    return engine;
}

}  // namespace culet
