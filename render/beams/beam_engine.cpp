// The engines "beams" and "preview".

#include <chrono>

#include "render/beams/frame_renderer.h"
#include "render/engine/engine.h"
#include "render/work/price.h"

namespace culet {

namespace {

class BeamEngine : public Engine {
public:
    explicit BeamEngine(const char* name) : name_(name) {}

    std::string name() const override { return name_; }
    std::string refuses(const Scene& scene, const OpticalSetup& setup) const override {
        return refused_by_beams(scene, setup);
    }
    double cost_ns(const DrawingWork& work) const override {
        BeamWork beams;
        beams.pixels = work.pixels;
        beams.bands = work.bands;
        beams.events_per_ray = work.faces_per_ray;
        beams.tolerance = work.tolerance;
        beams.cut = work.cut;
        beams.views = work.views;
        beams.polarised = work.polarised;
        beams.split = work.splits;
        beams.nodes = work.nodes;
        return price_ns(beams);
    }
    RenderResult draw(const Scene& scene, const Progress& progress) const override {
        const auto start = std::chrono::steady_clock::now();
        FrameRenderer frames(scene);
        frames.report_to(progress);
        frames.draw(scene.settings.check != Check::none);
        RenderResult result = frames.take();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        RenderStats& stats = result.stats;
        stats.seconds_setup =
            took.count() - stats.seconds_build - stats.seconds_shade - stats.seconds_check;
        return result;
    }
    bool approaches_truth() const override { return true; }

private:
    const char* name_;
};

}  // namespace

const Engine& beam_engine() {
    static const BeamEngine engine(k_beam_engine);
    return engine;
}

const Engine& preview_engine() {
    static const BeamEngine engine(k_preview_engine);
    return engine;
}

}  // namespace culet
