#include "viewer/engine/shown_stone.h"

#include <utility>

#include "render/scene/scene_io.h"
#include "render/scene/turned_lights.h"
#include "stone/errors.h"
#include "viewer/engine/stone_json.h"

namespace culet {

namespace {

constexpr std::array<double, 9> k_unturned{1, 0, 0, 0, 1, 0, 0, 0, 1};

// Whatever of a stone beams are built from: another of these is another stone.
std::string body_of(const Stone& stone) {
    nlohmann::ordered_json body = json_of(stone.material);
    for (const Vec3& axis : stone.crystal.axes) body["crystal"].push_back(json_of(axis));
    return body.dump();
}

}  // namespace

ShownStone::ShownStone(ViewedStone viewed, const std::string& scene_toml, const HeldFiles& files,
                       const std::string& name)
    : viewed_(std::move(viewed)) {
    set({}, scene_toml, files, name);
}

void ShownStone::set(const std::vector<std::string>& settings, const std::string& scene_toml,
                     const HeldFiles& files, const std::string& name) {
    const TomlTable root = toml_of_text(scene_toml, name, settings, files);
    Stone stone = viewed_.stone;
    apply_words_beside(root, stone);
    Scene scene = culet::scene_of(root, &stone);
    // As `culet render --engine beams --check none` draws it.
    scene.settings.check = Check::none;
    if (!drawn_by_beams(scene.settings)) scene.settings.engine = k_beam_engine;
    if (scene.film.glare > 0) {
        scene.film.glare = 0;
        scene.notes.emplace_back("glare is left out here: culet render draws it");
    }
    std::string refused = refused_by_beams(scene);
    std::string body = body_of(scene.stone);
    if (body != body_) drawers_ = {};
    for (auto& drawer : drawers_) {
        if (drawer) drawer->stale = true;
    }
    scene_ = std::move(scene);
    refused_ = std::move(refused);
    body_ = std::move(body);
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
        scene.lights = turned_lights(scene.lights, turn, centroid(scene.stone.solid));
    }
    return scene;
}

const RenderResult& ShownStone::draw(const FrameRequest& request) {
    if (!refused_.empty()) throw InputError(refused_);
    std::optional<Drawer>& drawer = drawers_[request.preview ? 1 : 0];
    const bool same = drawer && !drawer->stale && drawer->turn == request.turn &&
                      drawer->samples == request.samples;
    if (same && request.quick) {
        drawer->frames.look_from(request.camera);
    } else if (!drawer) {
        drawer.emplace(
            Drawer{FrameRenderer(scene_of(request)), request.turn, request.samples, false});
    } else {
        drawer->frames.show(scene_of(request));
        drawer->turn = request.turn;
        drawer->samples = request.samples;
        drawer->stale = false;
    }
    return drawer->frames.draw();
}

}  // namespace culet
