// The list of engines.

#include <algorithm>

#include "render/engine/engine.h"
#include "render/scene/engine_name.h"
#include "stone/text/errors.h"

namespace culet {

const Engine& reference_engine();  // reference/reference_engine.cpp
const Engine& beam_engine();       // beams/beam_engine.cpp
const Engine& preview_engine();    // beams/beam_engine.cpp
const Engine& raytable_engine();   // raytable/raytable_engine.cpp
const Engine& flat_engine();       // shaded/local_engines.cpp
const Engine& gouraud_engine();    // shaded/local_engines.cpp
const Engine& phong_engine();      // shaded/local_engines.cpp
const Engine& whitted_engine();    // shaded/whitted_engine.cpp
const Engine& gpu_engine();        // gpu/gpu_engine.cpp

const std::vector<const Engine*>& engines() {
    static const std::vector<const Engine*> all{
        &reference_engine(), &beam_engine(),     &preview_engine(),
        &flat_engine(),      &gouraud_engine(),  &phong_engine(),
        &whitted_engine(),   &raytable_engine(), &gpu_engine()};
    return all;
}

const Engine& engine_named(const std::string& name) {
    const auto found = std::find_if(engines().begin(), engines().end(),
                                    [&](const Engine* engine) { return engine->name() == name; });
    if (found == engines().end()) throw InternalError("no engine is called " + name);
    return **found;
}

const Engine& engine_of(const RenderSettings& settings) {
    return engine_named(settings.engine == k_auto_engine ? k_reference_engine : settings.engine);
}

std::vector<std::string> engine_names() {
    std::vector<std::string> names{k_auto_engine};
    for (const Engine* engine : engines()) names.push_back(engine->name());
    return names;
}

}  // namespace culet
