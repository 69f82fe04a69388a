#include "render/planner/quick_picture.h"

#include <limits>

#include "render/beams/frame_renderer.h"
#include "render/engine/engine.h"
#include "render/planner/wavelengths.h"
#include "render/setup/scene_checks.h"

namespace culet {

RenderResult draw_quickly(const Scene& scene, const Progress& progress) {
    require_renderable(scene);
    Scene quick = scene;
    RenderSettings& settings = quick.settings;
    settings.meter = nullptr;
    settings.allowed_ns = 0;
    // Takes about a second, and is fine enough to recognise the picture.
    settings.tolerance = 0.1;
    settings.cut_weight = settings.split_weight = 0.02;
    settings.crystal_beams = CrystalBeams::merged;
    settings.effects_auto = false;
    for (const Effects effect : {Effects::dispersion, Effects::polarization, Effects::aperture})
        settings.effects[static_cast<std::size_t>(effect)] = false;
    settings.meets_again = false;
    if (settings.wavelengths_nm.empty()) settings.wavelengths_nm = k_three_nm;
    RenderResult result;
    if (refused_by_beams(quick).empty()) {
        settings.engine = k_preview_engine;
        FrameRenderer frames(quick);
        frames.report_to(progress);
        frames.draw(false);
        result = frames.take();
    } else {
        settings.engine = k_reference_engine;
        settings.samples = 1;
        settings.effects[static_cast<std::size_t>(Effects::birefringence)] = false;
        result = engine_named(settings.engine).draw(quick, progress);
    }
    result.stats.error_bound = std::numeric_limits<double>::quiet_NaN();
    return result;
}

}  // namespace culet
