#include "viewer/view_item.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "page/fit_facts.h"
#include "page/html.h"
#include "render/beams/frame_renderer.h"
#include "render/image/exposure.h"
#include "render/image/image_io.h"
#include "render/planner/quick_picture.h"
#include "render/scene/shown_picture.h"

namespace culet {

namespace {

// Shown only for a moment. The wavelengths are those that the page uses while a stone moves, where
// the eye's three colours are separated best (page/scene_settings.js).
constexpr double k_still_tolerance = 0.2;
constexpr std::array k_still_nm{450.0, 540.0, 610.0};

std::string still_of(Scene scene, const std::string& refused) {
    Camera& camera = scene.camera;
    const double scale = static_cast<double>(k_still_size) / std::max(camera.width, camera.height);
    camera.width = std::max(1, static_cast<int>(std::lround(scale * camera.width)));
    camera.height = std::max(1, static_cast<int>(std::lround(scale * camera.height)));
    if (camera.principal_point) {
        for (double& place : *camera.principal_point) place *= scale;
    }
    scene.settings.check = Check::none;
    RenderResult result;
    if (refused.empty() && scene.stone.convex) {
        scene.settings.engine = k_beam_engine;
        scene.settings.tolerance = std::max(scene.settings.tolerance, k_still_tolerance);
        if (scene.settings.wavelengths_nm.empty())
            scene.settings.wavelengths_nm.assign(k_still_nm.begin(), k_still_nm.end());
        FrameRenderer frames(scene);
        frames.draw();
        result = frames.take();
    } else {
        result = draw_quickly(scene);
    }
    PngLook look = scene.film;
    look.ground = 0;  // the page's own
    look.exposure = shown_exposure("", scene).value_or(
        exposure_for_stone(result.picture, look.share_over_white));
    return png_uri(png_of(result.picture, look));
}

std::vector<FacetFacts> facts_of(const Solid& solid, const std::string& fit_json) {
    std::vector<std::string> names;
    for (const Facet& facet : solid.facets) names.push_back(facet.name);
    return facet_facts(names, fit_json);
}

}  // namespace

ViewItem view_item(const ViewSource& source, std::vector<std::string>& notes) {
    Scene scene;
    ViewItem item = item_of(source, notes, scene);
    if (!source.fit_json.empty() && !item.stones.empty())
        item.stones.back().fit = facts_of(scene.stone.solid, source.fit_json);
    item.picture = still_of(std::move(scene), item.refused);
    return item;
}

}  // namespace culet
