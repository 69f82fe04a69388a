#include "app/render/saved_plan.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "render/scene/fingerprint.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

SavedPlan read_saved_plan(const std::filesystem::path& file) {
    using Json = nlohmann::json;
    const Json stats = Json::parse(read_text(file), nullptr, false);
    if (stats.is_discarded())
        throw InputError(file, "is not JSON: --plan takes what --stats wrote");
    // `--explain --stats` writes the plan itself.
    const Json plan = stats.is_object() && stats.contains("plan") ? stats["plan"] : stats;
    if (!plan.is_object() || !plan.contains("settings") || !plan["settings"].is_object() ||
        !plan.contains("stone_and_light") || !plan["stone_and_light"].is_string())
        throw InputError(file,
                         "has no plan: `culet render SCENE -o IMAGE --stats FILE` writes one if "
                         "the scene leaves settings open");
    SavedPlan saved;
    saved.file = file;
    // Read like a scene's own settings, with the same checks. JSON's values are valid TOML.
    for (const auto& [key, value] : plan["settings"].items())
        saved.settings.push_back("render." + key + "=" + value.dump());
    saved.stone_and_light = plan["stone_and_light"].get<std::string>();
    const auto bound = plan.find("checked_bound");
    saved.checked_bound = bound != plan.end() && bound->is_number()
                              ? bound->get<double>()
                              : std::numeric_limits<double>::quiet_NaN();
    return saved;
}

ScenePlan SavedPlan::of(const Scene& scene) const {
    Fingerprint print;
    print.add_stone_and_light(scene);
    if (print.hex() != stone_and_light)
        throw InputError(file,
                         "is of another stone or other lights: draw this scene once without "
                         "--plan, with --stats FILE, and give that file");
    ScenePlan plan;
    plan.settings = scene.settings;
    plan.tolerance = scene.settings.tolerance;
    plan.stone_and_light = stone_and_light;
    plan.checked_bound = checked_bound;
    return plan;
}

}  // namespace culet
