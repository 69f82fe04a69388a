#include "studio/photograph_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/calibration/scene_comparison.h"
#include "compare/photo/photo_picture.h"
#include "compare/photo/raw_file.h"
#include "compare/pose/find_pose.h"
#include "compare/report/report.h"
#include "fit/fit.h"
#include "refine/fit_uncertainty.h"
#include "render/scene/light_presets.h"
#include "render/scene/scene_io.h"
#include "render/scene/stone_scene.h"
#include "stone/file_kind.h"
#include "stone/numbers/quantile.h"
#include "stone/progress/part_of_progress.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"
#include "stone/text/path_fence.h"
#include "stone/text/text_scan.h"
#include "stone/text/toml_file.h"
#include "studio/fit_work.h"
#include "studio/json_text.h"
#include "studio/photograph_view.h"
#include "studio/photograph_words.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

// The longer side in pixels: as the page shows it; and as the stone is sought, where more would not
// help (docs/registration.md).
constexpr int k_shown = 1600, k_sought = 1200;
constexpr std::size_t k_most_listed = 100;
// Without EXIF data a photograph is taken as made from twenty times the stone's diameter.
constexpr double k_usual_distance = 20, k_usual_share = 0.6, k_unknown_focal = 0.5;
constexpr double k_quick_seconds = 4;

bool is_photograph(const fs::path& file) {
    return kind_of(extension_of(file) == "toml" ? fs::path() : file) == FileKind::picture ||
           has_raw_extension(file);
}

struct Setup {
    Scene scene;
    WireSolid wire;
};

Setup set_up(const PhotographAsk& ask, const PhotographJob& job) {
    const PathFence fence(ask.folder);
    const Stone stone = stone_shown(*ask.loaded, ask.fitted.solid);
    if (ask.light.empty() && job.scene.empty())
        throw InputError("job.toml names no scene any more: choose another light");
    if (!ask.light.empty() && find_light_preset(ask.light) == nullptr)
        throw InputError(no_light_preset(ask.light));
    Scene scene = ask.light.empty() ? read_scene(job.scene, {}, &stone)
                                    : scene_around(stone, {}, {{}, ask.light, {}});
    const Solid& solid = scene.stone.solid;
    if (!is_closed(solid) || !is_convex(solid))
        throw InputError("only a closed, convex stone is laid on a photograph");
    WireSolid wire(solid);
    return {std::move(scene), std::move(wire)};
}

bool is_of_job(const PhotographAsk& ask, const PhotographJob& job) {
    std::error_code ignored;
    return fs::equivalent(ask.file, job.photo, ignored);
}

Photo photo_of(const PhotographAsk& ask, const PhotographJob& job) {
    return read_photo(ask.file, is_of_job(ask, job) ? job.mask : fs::path());
}

double focal_of(const Photo& photo) {
    return focal_px_of(photo.shot, std::hypot(photo.width, photo.height));
}

// Where the scene's camera stands, if its light is chosen; or else straight above.
StoneView first_view(const PhotographAsk& ask, const Setup& setup, const Photo& photo) {
    Camera camera = setup.scene.camera;
    if (ask.light.empty() && !camera.cone) {
        if (camera.principal_point) {
            (*camera.principal_point)[0] *= double(photo.width) / camera.width;
            (*camera.principal_point)[1] *= double(photo.height) / camera.height;
        }
        if (camera.orthographic_width)
            *camera.orthographic_width *=
                double(photo.width) * camera.height / (double(camera.width) * photo.height);
        camera.width = photo.width;
        camera.height = photo.height;
        return stone_view(camera, setup.wire.middle);
    }
    StoneView view;
    view.turn = {1, 0, 0, 0, -1, 0, 0, 0, -1};
    view.middle = setup.wire.middle;
    view.at = view.sight = {0.5 * photo.width, 0.5 * photo.height};
    view.scale = k_usual_share * std::min(photo.width, photo.height) / setup.wire.diameter;
    const double focal = focal_of(photo);
    view.nearness = focal > 0 ? view.scale / focal : 1 / (k_usual_distance * setup.wire.diameter);
    return view;
}

Camera camera_in(const StoneView& view, const PhotoPart& part, const Scene& scene) {
    Camera like = scene.camera;
    like.width = part.width;
    like.height = part.height;
    like.cone.reset();
    like.optics = {};
    return camera_of(in_part(view, part), like);
}

// With the outline as placed, if that is asked for.
Photo working(const Photo& whole, const PhotoPart& part, const PhotographAsk& ask,
              const Setup& setup, const StoneView& view) {
    Photo photo = cut_out(whole, part);
    if (ask.by_hand) photo.mask = mask_of(photo, setup.wire, in_part(view, part));
    return photo;
}

Report report_of(const PhotographAsk& ask, Comparison comparison) {
    Report report;
    report.title = ask.file.filename().string();
    report.version = ask.version;
    report.comparison = std::move(comparison);
    return report;
}

}  // namespace

PhotographJob photograph_job(const fs::path& folder) {
    PhotographJob job;
    const fs::path file = folder / "job.toml";
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return job;
    path_within(folder, "job.toml");
    const PathFence fence(folder);
    const TomlTable root = read_toml(file);
    if (const auto compare = root.table("compare")) {
        job.photo = compare->path("photo").value_or("");
        job.mask = compare->path("mask").value_or("");
        job.simulated = compare->boolean("simulated").value_or(false);
    }
    if (const auto render = root.table("render")) job.scene = render->path("scene").value_or("");
    return job;
}

std::string photographs_json(const fs::path& folder) {
    PhotographJob job;
    Json json{{"files", Json::array()}, {"lights", Json::array()}};
    try {
        job = photograph_job(folder);
    } catch (const InputError& error) {
        json["trouble"] = error.what();
    }
    std::vector<std::string> files;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with('.') && entry.is_regular_file(ignored) && is_photograph(name))
            files.push_back(name);
    }
    std::sort(files.begin(), files.end());
    if (!job.photo.empty()) {
        const std::string name = fs::relative(job.photo, folder, ignored).string();
        std::erase(files, name);
        files.insert(files.begin(), name);
    }
    if (files.size() > k_most_listed) files.resize(k_most_listed);
    for (const std::string& name : files) json["files"].push_back(name);
    if (!job.scene.empty()) json["lights"].push_back("");
    for (const LightPreset& preset : light_presets()) {
        if (!preset.instrument) json["lights"].push_back(preset.name);
    }
    return text_of(json);
}

std::string opened_photograph(PhotographAsk ask) {
    const PhotographJob job = photograph_job(ask.folder);
    const Photo photo = photo_of(ask, job);
    std::string without;
    if (job.scene.empty()) ask.light = k_usual_light;
    const Setup setup = [&] {
        try {
            return set_up(ask, job);
        } catch (const InputError& error) {
            if (!ask.light.empty()) throw;
            without = fmt::format("not in the scene of job.toml: {}", error.what());
        }
        ask.light = k_usual_light;
        return set_up(ask, job);
    }();
    Photo shown = cut_out(photo, whole_of(photo, k_shown));
    if (bits_of(photo) != 8) {
        // Linear files may be of any brightness.
        const float white = quantile(shown.rgb, 0.99);
        for (float& value : shown.rgb) value *= white > 0 ? 1 / white : 1;
    }
    Json json{
        {"width", photo.width},
        {"height", photo.height},
        {"notes", {fmt::format("{} x {} pixels, {}", photo.width, photo.height, photo.encoding)}},
        {"light", ask.light},
        {"view", json_of(first_view(ask, setup, photo))},
        {"wire", json_of(setup.wire)}};
    if (!without.empty()) json["notes"].push_back(without);
    if (photo.shot.known()) json["notes"].push_back(text_of(photo.shot));
    if (!ask.loaded->file.has_material)
        json["notes"].push_back("the stone file names no material: drawn as diamond");
    for (const std::string& note : photo.notes) json["notes"].push_back(note);
    return text_of(json) + "\n" + png_of(shown);
}

std::string laid_photograph(const PhotographAsk& ask, const Progress& progress) {
    const PhotographJob job = photograph_job(ask.folder);
    const Photo whole = photo_of(ask, job);
    const Setup setup = set_up(ask, job);
    const StoneView start =
        ask.view.empty() ? first_view(ask, setup, whole) : view_of(ask.view, setup.wire);
    PoseOptions options;
    options.all_turns = !ask.placed;
    if (!ask.light.empty() && !(focal_of(whole) > 0)) options.focal_error = k_unknown_focal;
    // Near the outline first: what else the photograph shows does not count there.
    std::vector<PhotoPart> parts;
    if (ask.placed || ask.by_hand) parts.push_back(part_around(whole, setup.wire, start, k_sought));
    if (!ask.by_hand) parts.push_back(whole_of(whole, k_sought));
    FoundPose pose;
    StoneView laid = start;
    for (std::size_t i = 0; i < parts.size() && (i == 0 || !pose.usable()); ++i) {
        if (parts[i].width == 0 || parts[i].height == 0) {
            pose.trouble = "the outline lies beside the photograph";
            pose.remedy = "Draw it onto the stone";
            continue;
        }
        pose = find_pose(working(whole, parts[i], ask, setup, start), setup.scene.stone.solid,
                         camera_in(start, parts[i], setup.scene), options,
                         part_of(progress, double(i) / double(parts.size()), 1));
        if (pose.usable()) laid = in_whole(stone_view(pose.camera, setup.wire.middle), parts[i]);
    }
    return text_of(Json{{"found", pose.usable()},
                        {"sure", pose.usable() && pose.sigmas.angle_99 <= k_sure_pose},
                        {"view", json_of(laid)},
                        {"wire", json_of(setup.wire)},
                        {"card_html", pose_card(pose)}});
}

std::string compared_photograph(const PhotographAsk& ask, PhotographLook look,
                                const Progress& progress) {
    const PhotographJob job = photograph_job(ask.folder);
    const Photo whole = photo_of(ask, job);
    Setup setup = set_up(ask, job);
    const StoneView laid = view_of(ask.view, setup.wire);
    const PhotoPart part = part_around(whole, setup.wire, laid, k_sought);
    if (part.width == 0 || part.height == 0)
        throw InputError("the outline lies beside the photograph: draw it onto the stone");
    const Photo photo = working(whole, part, ask, setup, laid);
    setup.scene.camera = camera_in(laid, part, setup.scene);
    SceneCompareOptions options;
    options.compare.simulated = job.simulated && is_of_job(ask, job);
    options.find_pose = look == PhotographLook::nearby;
    if (look == PhotographLook::quick) options.budget_seconds = k_quick_seconds;
    if (look == PhotographLook::open) {
        if (ask.fitted.report.empty())
            throw InputError("there is no fit yet, which says what the readings leave open");
        const FitResult fit =
            fit_stone(fit_input(ask.loaded->file.stone, ask.loaded->written), ask.loaded->options);
        setup.scene.stone.solid = fit.solid;
        options.uncertainty = uncertainty_of(fit);
    }
    SceneComparison compared = compare_with_scene(photo, setup.scene, options, progress);
    Json json{{"notes", Json::array()}};
    if (!compared.comparison.pose_note.empty())
        json["notes"].push_back(sentences(compared.comparison.pose_note));
    for (const std::string& note : compared.comparison.notes)
        json["notes"].push_back(sentences(note));
    if (compared.pose && compared.pose_used)
        json["view"] =
            json_of(in_whole(stone_view(compared.pose->camera, setup.wire.middle), part));
    json["html"] = reworded(comparison_part(report_of(ask, std::move(compared.comparison))));
    return text_of(json);
}

}  // namespace culet
