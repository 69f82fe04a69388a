#pragma once
// The options of `culet render`.

#include <optional>
#include <string>

#include "app/program/options.h"
#include "render/scene/stone_scene.h"

namespace culet {

struct RenderOptions {
    CommonOptions common;
    std::string scene, out, stats, plan, engine, effects, check, exposure, size, tonemap, table,
        uncertainty;
    StoneScene stone;
    std::optional<int> depth, frames;
    double turn_deg = 360;
    std::optional<double> tolerance;
    int draws = 100;
    bool spectral = false, explain = false, verify = false;
};

/// `options` must outlive `command`.
void add_render_options(CLI::App& command, RenderOptions& options);

}  // namespace culet
