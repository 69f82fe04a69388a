#include "compare/study/graded_design.h"

#include <fmt/format.h>

#include "page/html.h"
#include "render/grade/path_section.h"
#include "render/image/image_io.h"
#include "render/render.h"
#include "render/scene/framing.h"
#include "render/scene/light_presets.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

struct Scope {
    const char *preset, *title;
};
constexpr Scope k_scopes[] = {{"aset", "ASET"},
                              {"idealscope", "Ideal-scope"},
                              {"darkfield", "Dark field"},
                              {"hearts", "Hearts"},
                              {"arrows", "Arrows"}};

Scene scene_in(const Stone& stone, const LightPreset& preset, const GradePageOptions& options) {
    Scene scene;
    scene.stone = stone;
    scene.lights = *light_preset(preset.name);
    scene.light_preset = preset.name;
    scene.camera.width = scene.camera.height = options.size;
    frame_stone(stone.solid, preset.facing, scene.camera);
    RenderSettings& settings = scene.settings;
    settings.engine = k_beam_engine;
    settings.check = Check::none;
    settings.threads = options.threads;
    settings.effects_auto = false;
    settings.effects.fill(false);
    settings.effects[static_cast<std::size_t>(Effects::dispersion)] =
        !stone.material.index[0].is_constant();
    settings.effects[static_cast<std::size_t>(Effects::polarization)] = true;
    return scene;
}

std::vector<GradePicture> draw_scopes(const Stone& stone, const std::filesystem::path& folder,
                                      const std::string& prefix, const GradePageOptions& options) {
    std::vector<GradePicture> pictures;
    for (const Scope& scope : k_scopes) {
        const LightPreset& preset = *find_light_preset(scope.preset);
        const std::string png = png_of(render(scene_in(stone, preset, options)).picture, {});
        if (!folder.empty())
            write_text(folder / fmt::format("{}-{}.png", prefix, scope.preset), png);
        pictures.push_back({scope.title, preset.summary, png_uri(png)});
    }
    return pictures;
}

}  // namespace

GradeDesign graded_design(const GradedStone& graded, const std::filesystem::path& folder,
                          const std::string& prefix, const GradePageOptions& options) {
    GradeDesign design;
    design.json = graded.json;
    Stone stone = graded.stone;
    if (!graded.has_material) {
        // An index alone has no dispersion.
        stone.material = Material();
        stone.material.index[0].n = graded.grade.index.n;
    }
    design.pictures = draw_scopes(stone, folder, prefix, options);
    design.section_json =
        section_json(path_section(stone.solid, graded.grade.index.n, radians(options.head_deg)));
    design.solid = stone.solid;
    return design;
}

}  // namespace culet
