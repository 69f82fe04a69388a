#include "viewer/engine/shown_stone.h"

#include <algorithm>
#include <utility>

#include "render/engine/engine.h"
#include "render/planner/quick_picture.h"
#include "render/scene/scene_io.h"
#include "render/scene/turned_lights.h"
#include "stone/text/errors.h"
#include "viewer/engine/stone_json.h"

namespace culet {

namespace {

constexpr std::array<double, 9> k_unturned{1, 0, 0, 0, 1, 0, 0, 0, 1};

// Turning a map samples it anew; while the stone moves, a coarse map is used.
constexpr int k_quick_map_width = 256;

std::shared_ptr<const EnvironmentMap> coarse(const EnvironmentMap& map) {
    const int by = (map.width + k_quick_map_width - 1) / k_quick_map_width;
    auto small = std::make_shared<EnvironmentMap>();
    small->width = map.width / by;
    small->height = std::max(1, map.height / by);
    small->rgb.assign(3 * static_cast<std::size_t>(small->width * small->height), 0);
    const auto share = 1 / static_cast<float>(by * by);
    for (int y = 0; y < std::min(small->height * by, map.height); ++y) {
        for (int x = 0; x < small->width * by; ++x) {
            float* to = small->rgb.data() + 3 * (y / by * small->width + x / by);
            const float* from = map.rgb.data() + 3 * (y * map.width + x);
            for (int c = 0; c < 3; ++c) to[c] += share * from[c];
        }
    }
    return small;
}

// Everything of a stone from which beams are built; a change needs new beams.
std::string body_of(const Stone& stone) {
    nlohmann::ordered_json body = json_of(stone.material);
    for (const Vec3& axis : stone.crystal.axes) body["crystal"].push_back(json_of(axis));
    return body.dump();
}

}  // namespace

std::string refused_by_page(Scene scene) {
    scene.stone.convex = true;  // skips the test
    return refused_by_beams(scene);
}

ShownStone::ShownStone(ViewedStone viewed, const std::string& scene_toml, const HeldFiles& files,
                       const std::string& name)
    : viewed_(std::move(viewed)) {
    set({}, scene_toml, files, name);
}

void ShownStone::set(const std::vector<std::string>& settings, const std::string& scene_toml,
                     const HeldFiles& files, const std::string& name) {
    const TomlTable root = toml_of_text(scene_toml, name, settings, files);
    Stone stone = viewed_.stone;
    apply_stone_keys(root, stone);
    Scene scene = culet::scene_of(root, &stone);
    // As `culet render --engine beams --check none` draws it.
    scene.settings.check = Check::none;
    if (!drawn_by_beams(scene.settings)) scene.settings.engine = k_beam_engine;
    if (scene.film.glare > 0) {
        scene.film.glare = 0;
        scene.notes.emplace_back("glare is left out here: culet render draws it");
    }
    std::string refused = refused_by_page(scene);
    std::string body = body_of(scene.stone);
    if (body != body_) drawers_ = {};
    for (auto& drawer : drawers_) {
        if (drawer) drawer->stale = true;
    }
    coarse_map_.reset();
    on_gpu_.reset();
    scene_ = std::move(scene);
    refused_ = std::move(refused);
    body_ = std::move(body);
}

const GpuSetup& ShownStone::on_gpu() const {
    if (!on_gpu_) on_gpu_ = gpu_setup(scene_);
    return *on_gpu_;
}

Scene ShownStone::scene_of(const FrameRequest& request) const {
    Scene scene = scene_;
    scene.camera = request.camera;
    scene.settings.engine = request.preview ? k_preview_engine : k_beam_engine;
    if (request.samples) scene.settings.samples = *request.samples;
    if (request.turn != k_unturned) {
        glm::dmat3 turn;
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                turn[column][row] = request.turn[static_cast<std::size_t>(3 * row + column)];
        }
        if (request.quick && scene.lights.environment) {
            if (!coarse_map_) coarse_map_ = coarse(*scene.lights.environment);
            scene.lights.environment = coarse_map_;
        }
        scene.lights = turned_lights(scene.lights, turn, centroid(scene.stone.solid));
    }
    return scene;
}

const RenderResult& ShownStone::draw(const FrameRequest& request) {
    if (!refused_.empty()) throw InputError(refused_);
    std::unique_ptr<Drawer>& drawer = drawers_[request.preview ? 1 : 0];
    Scene scene = scene_of(request);
    if (!scene.stone.convex) {
        scene.settings.engine = k_reference_engine;
        traced_ = request.preview ? draw_quickly(scene)
                                  : engine_named(scene.settings.engine).draw(scene, {});
        return traced_;
    }
    if (!drawer) {
        drawer.reset(new Drawer{FrameRenderer(scene), request.samples, false});
    } else if (request.quick && !drawer->stale && drawer->samples == request.samples) {
        drawer->frames.look_from(request.camera, scene.lights);
    } else {
        drawer->frames.show(scene);
        drawer->samples = request.samples;
        drawer->stale = false;
    }
    return drawer->frames.draw();
}

}  // namespace culet
