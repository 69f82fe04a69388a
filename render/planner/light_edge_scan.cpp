#include "render/planner/light_edge_scan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <optional>

#include "render/beams/frame_renderer.h"
#include "render/planner/policy.h"
#include "render/planner/wavelengths.h"
#include "render/setup/a_priori.h"
#include "stone/solid/solid.h"

namespace culet {

namespace {

// The same view with pixels `times` as large; the last ones may extend beyond it.
Camera coarser(const Camera& camera, int times) {
    Camera result = camera;
    result.width = (camera.width + times - 1) / times;
    result.height = (camera.height + times - 1) / times;
    const auto middle = line_of_sight_in(camera);
    result.principal_point = {middle[0] / times, middle[1] / times};
    if (camera.orthographic_width) {
        result.orthographic_width =
            *camera.orthographic_width * result.width * times / camera.width;
    } else {
        result.fov =
            2 * std::atan(std::tan(camera.fov / 2) * result.height * times / camera.height);
    }
    return result;
}

// The brightest texel of each cell, if it reaches this radiance. Cells are wider than any stone's
// dispersion.
std::shared_ptr<const EnvironmentMap> brightest_of(const EnvironmentMap& map, double least) {
    auto found = std::make_shared<EnvironmentMap>();
    found->width = std::min(map.width, 64);
    found->height = std::min(map.height, 32);
    found->rgb.assign(3 * static_cast<std::size_t>(found->width * found->height), 0.0f);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const std::size_t from = 3 * static_cast<std::size_t>(y * map.width + x);
            const int row = y * found->height / map.height, column = x * found->width / map.width;
            const std::size_t to = 3 * static_cast<std::size_t>(row * found->width + column);
            for (std::size_t c = 0; c < 3; ++c)
                found->rgb[to + c] = std::max(found->rgb[to + c], map.rgb[from + c]);
        }
    }
    for (auto texel = found->rgb.begin(); texel != found->rgb.end(); texel += 3) {
        if (static_cast<double>(*std::max_element(texel, texel + 3)) < least)
            std::fill_n(texel, 3, 0.0f);
    }
    return found;
}

// One ray per pixel, averaged over wavelengths.
std::vector<double> mean_spectra(const Scene& scene, const StonePixels& pixels,
                                 const Progress& progress) {
    PathLimits limits;
    limits.seed = scene.settings.seed;
    limits.depth = scene.settings.depth > 0 ? scene.settings.depth : k_deepest;
    limits.cut_weight = scene.settings.cut_weight.value_or(k_cut_weight);
    limits.split_weight = 1;
    limits.roulette = !scene.stone.convex;
    const PilotDrawing drawing = draw_pilot(scene, pixels, limits, 1, k_node_counts[0], progress);
    const std::size_t count = drawing.wavelengths_nm.size();
    std::vector<double> seen(pixels.at.size(), 0.0);
    for (std::size_t i = 0; i < drawing.spectra.size(); ++i)
        seen[i / count] += drawing.spectra[i] / static_cast<double>(count);
    return seen;
}

// Keeps the environment map.
Lights bright_lights(const Lights& lights, double least) {
    const WavelengthSet colours(even_wavelengths(k_node_counts[0]));
    const auto dim = [&](const Light& light) {
        const std::vector<double> radiance = radiance_of(colour_of(light), colours);
        return *std::max_element(radiance.begin(), radiance.end()) < least;
    };
    Lights bright = lights;
    bright.constant = 0;
    std::erase_if(bright.sources, dim);
    return bright;
}

}  // namespace

Lights light_rims(const Lights& all, const Vec3& stone, double width, double least) {
    const Lights lights = bright_lights(all, least);
    Lights rims;
    for (const Light& light : lights.sources) {
        std::visit([&](const auto& l) { add_rims(l, stone, width, rims.sources); }, light);
    }
    if (lights.environment) rims.environment = brightest_of(*lights.environment, least);
    return rims;
}

namespace {

// Simplifies the scene: one path through the stone, unpolarised and unabsorbed.
Scene plainly(const Scene& whole, const Brightness& bright, bool disperses) {
    Scene scene = whole;
    RenderSettings& settings = scene.settings;
    settings.effects_auto = false;
    settings.effects.fill(false);
    settings.effects[static_cast<std::size_t>(Effects::dispersion)] = disperses;
    settings.wavelength_turns = 1;
    settings.coherence = false;
    // A preview's regions lie beside those that show a sun.
    settings.engine = bright.sun() ? k_beam_engine : k_preview_engine;
    settings.cut_weight =
        bright.sun() ? std::max(bright.least / bright.most, k_cut_weight / 100) : k_cut_weight;
    settings.wavelengths_nm = disperses ? std::vector<double>{460, 560} : std::vector<double>{550};
    scene.camera.aperture_radius = 0;
    scene.camera.optics = {};
    return scene;
}

// The brightest pixel of each cell that shows any light.
void find_brightest(const Picture& picture, int columns, int rows, StonePixels& at,
                    std::vector<double>& seen) {
    std::vector<std::pair<int, int>> best(static_cast<std::size_t>(columns * rows));
    std::vector<float> most(best.size(), 0.0f);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const float* rgb = picture.at(x, y);
            const float here = (std::abs(rgb[0]) + std::abs(rgb[1]) + std::abs(rgb[2])) / 3;
            const std::size_t cell = static_cast<std::size_t>(y / k_cell * columns + x / k_cell);
            if (!(here > most[cell])) continue;
            most[cell] = here;
            best[cell] = {x, y};
        }
    }
    for (std::size_t cell = 0; cell < most.size(); ++cell) {
        if (!(most[cell] > 0)) continue;
        at.at.push_back(best[cell]);
        seen.push_back(static_cast<double>(most[cell]));
    }
}

// Redraws the brightest cells with the scene's current wavelengths and lights.
void look_closer(const Scene& scene, const StonePixels& at, std::size_t cells,
                 std::vector<double>& seen, const Progress& progress) {
    std::vector<std::size_t> order(seen.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return seen[a] > seen[b]; });
    order.resize(std::min(order.size(), cells));
    StonePixels some;
    for (const std::size_t i : order) some.at.push_back(at.at[i]);
    const std::vector<double> found = mean_spectra(scene, some, progress);
    // Scales the other cells by the share that was confirmed in these.
    double possible = 0, actual = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        possible += seen[order[k]];
        actual += found[k];
    }
    if (possible > 0)
        for (double& cell : seen) cell *= std::min(1.0, actual / possible);
    for (std::size_t k = 0; k < order.size(); ++k) seen[order[k]] = found[k];
}

// Makes the pixels larger where the stone covers many; returns how many times.
int coarsen(Scene& scene) {
    const double across = diameter(scene.stone.solid) / pixel_on_stone(scene);
    const int times = static_cast<int>(std::clamp(across / k_across, 1.0, 100.0));
    // Beams that fill little of a pixel are not split. In smaller pictures, allow the same share of
    // the stone.
    scene.settings.tolerance = 0.1 * std::pow(std::min(1.0, across / k_across), 2);
    if (times > 1) scene.camera = coarser(scene.camera, times);
    return times;
}

// The angle between rays behind the stone that a pixel apart enter it. At an exit angle of 60
// degrees, refraction widens it by the index times two, the inverse of that angle's cosine.
double pixel_angle(const Scene& scene, const Vec3& middle, double index) {
    return 2 * index * pixel_on_stone(scene) /
           std::max(glm::length(scene.camera.position - middle), 1e-300);
}

}  // namespace

LightEdgeScan::LightEdgeScan(const Scene& whole, const Brightness& bright, const Progress& progress,
                             FrameRenderer* frames) {
    const bool disperses = whole.settings.effects_auto ||
                           whole.settings.effects[static_cast<std::size_t>(Effects::dispersion)];
    Scene scene = plainly(whole, bright, disperses);
    const Vec3 middle = centroid(scene.stone.solid);
    const IndexSpans spans = index_spans(scene);
    const double apart = disperses ? exit_deviation(spans.dispersion, spans.mean) / 2 : 0;
    const auto pixel = [&] { return pixel_angle(scene, middle, spans.mean); };
    // A map's brightest texels do not depend on the width.
    Lights lights = whole.lights;
    const auto map = lights.environment ? brightest_of(*lights.environment, bright.least) : nullptr;
    lights.environment.reset();
    const auto light = [&](double width) {
        scene.lights = light_rims(lights, middle, width, bright.least);
        scene.lights.environment = map;
    };

    // One pixel per cell: with beams the brightest, else any.
    StonePixels at;
    std::vector<double> seen;
    int times = 1, rows = 0;
    double step = k_cell;  // cell size in these pixels
    light(apart + pixel());
    if (refused_by_beams(scene).empty()) {
        times = coarsen(scene);
        light(apart + pixel());
        std::optional<FrameRenderer> own;
        if (frames == nullptr) {
            frames = &own.emplace(scene);
            frames->report_to(progress);
        } else {
            frames->show(scene);
        }
        const Picture& picture = frames->draw(false).picture;
        columns_ = picture.width / k_cell + 1;
        rows = picture.height / k_cell + 1;
        find_brightest(picture, columns_, rows, at, seen);
    } else {
        at = stone_pixels(scene, k_scanned_pixels);
        if (at.at.empty()) return;
        step = std::max(1.0, std::sqrt(at.in_picture / static_cast<double>(at.at.size())));
        columns_ = static_cast<int>(scene.camera.width / step) + 1;
        rows = static_cast<int>(scene.camera.height / step) + 1;
        light(apart + step * pixel());
        seen = mean_spectra(scene, at, progress);
    }
    for (const auto& [cells, wavelengths] : k_closer) {
        if (!disperses) break;
        // Rims that bridge the gaps between the wavelengths.
        scene.settings.wavelengths_nm = even_wavelengths(wavelengths);
        light(2 * apart / wavelengths + step * pixel());
        look_closer(scene, at, cells, seen, progress);
    }
    spread(at, seen, step, rows);
    side_ = step * times;
}

// Each cell spreads to its eight neighbours.
void LightEdgeScan::spread(const StonePixels& at, const std::vector<double>& seen, double step,
                           int rows) {
    cells_.assign(static_cast<std::size_t>(columns_ * rows), 0.0f);
    for (std::size_t i = 0; i < at.at.size(); ++i) {
        const int column = static_cast<int>(at.at[i].first / step),
                  row = static_cast<int>(at.at[i].second / step);
        for (int r = std::max(0, row - 1); r <= std::min(rows - 1, row + 1); ++r) {
            for (int c = std::max(0, column - 1); c <= std::min(columns_ - 1, column + 1); ++c) {
                float& cell = cells_[static_cast<std::size_t>(r * columns_ + c)];
                cell = std::max(cell, static_cast<float>(seen[i]));
            }
        }
    }
}

double LightEdgeScan::near(int x, int y) const {
    if (cells_.empty()) return 0;
    const int row = static_cast<int>(y / side_), column = static_cast<int>(x / side_);
    return static_cast<double>(cells_[static_cast<std::size_t>(row * columns_ + column)]);
}

}  // namespace culet
