#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/describe/describe.h"
#include "render/image/image_io.h"
#include "render/scene/scene_io.h"
#include "stone/numbers/units.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

void describe_objects(const Scene& scene, Description& about) {
    auto& list = about.object["objects"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const auto name = [](const auto& kind) { return kind.k_name; };
        const SceneObject& object = scene.objects[i];
        const char* shape = std::visit(name, object.shape);
        const char* material = std::visit(name, object.material);
        list.push_back({{"shape", shape}, {"material", material}});
        std::string line = fmt::format("object {}: {}, {}", i, shape, material);
        if (const auto* mesh = std::get_if<MeshShape>(&object.shape)) {
            line += fmt::format(", {} triangles", mesh->mesh->triangles.size());
            list.back()["triangles"] = mesh->mesh->triangles.size();
        }
        about.lines.push_back(std::move(line));
    }
    auto& stones = about.object["more_stones"] = nlohmann::ordered_json::array();
    for (const Stone& stone : scene.more_stones) {
        stones.push_back({{"name", stone.name}, {"material", stone.material.id}});
        about.lines.push_back(fmt::format("beside it: \"{}\", {}, {} facets", stone.name,
                                          stone.material.id, stone.solid.facets.size()));
    }
}

}  // namespace

Description describe_scene_file(const DescribeOptions& options) {
    const Scene scene = read_scene(options.file, options.overrides);
    Description about;
    about.notes = scene.notes;
    auto& object = about.object;
    object["format"] = "scene";
    object["stone"] = scene.stone.name;
    const Camera& camera = scene.camera;
    object["camera"] = {{"position", {camera.position.x, camera.position.y, camera.position.z}},
                        {"look_at", {camera.look_at.x, camera.look_at.y, camera.look_at.z}},
                        {"size", {camera.width, camera.height}}};
    const Lights& lights = scene.lights;
    object["lights"] = {{"environment", lights.environment != nullptr},
                        {"constant", lights.constant}};
    std::string counts;
    for_each_light_type([&]<class L>() {
        const std::size_t count = count_lights<L>(lights);
        object["lights"][L::k_names] = count;
        counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, L::k_names);
    });
    const EyeOptics& optics = camera.optics;
    if (camera.cone) object["camera"]["cone"] = degrees(*camera.cone);
    if (optics.analyzer) object["camera"]["analyzer"] = degrees(*optics.analyzer);
    if (optics.two_windows) object["camera"]["windows"] = 2;
    object["immersion"] = scene.immersion;
    object["engine"] = scene.settings.engine;
    object["depth"] = scene.settings.depth;
    object["tolerance"] = scene.settings.tolerance;
    about.lines.push_back(fmt::format(
        "{}: scene, {} x {} pixels, {}", options.file.string(), camera.width, camera.height,
        scene.has_stone() ? fmt::format("stone \"{}\"", scene.stone.name) : "no stone"));
    about.lines.push_back(fmt::format("lights: {}{}",
                                      lights.environment
                                          ? "an environment, "
                                          : (lights.constant > 0 ? "a constant environment, " : ""),
                                      counts));
    if (optics.analyzer) {
        about.lines.push_back(
            fmt::format("seen through an analyser at {:g} degrees{}{}", degrees(*optics.analyzer),
                        optics.two_windows ? " and one across it" : "",
                        camera.cone ? ", in all directions through a point" : ""));
    }
    if (scene.immersion != 1)
        about.lines.push_back(fmt::format("in a liquid of index {:g}", scene.immersion));
    describe_objects(scene, about);
    if (!scene.has_stone()) return about;
    describe_material(scene.stone.material, about);
    describe_solid(scene.stone.solid, scene.stone.convex && !options.may_be_concave,
                   options.facet_table, about);
    return about;
}

Description describe_image_file(const DescribeOptions& options) {
    const ReadPicture read = read_picture(options.file);
    const Picture& picture = read.picture;
    Description about;
    double low = INFINITY, high = -INFINITY;
    Rgb sum{0, 0, 0};
    std::size_t not_finite = 0, first_of_them = 0;
    for (std::size_t p = 0; p < picture.pixels(); ++p) {
        bool finite = true;
        for (std::size_t c = 0; c < 3; ++c) finite &= std::isfinite(picture.rgb[3 * p + c]);
        if (!finite) {
            if (not_finite++ == 0) first_of_them = p;
            continue;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const double value = static_cast<double>(picture.rgb[3 * p + c]);
            low = std::min(low, value);
            high = std::max(high, value);
            sum[c] += value;
        }
    }
    const std::size_t counted = picture.pixels() - not_finite;
    if (counted == 0) low = high = 0;
    for (std::size_t c = 0; c < 3 && counted > 0; ++c) sum[c] /= static_cast<double>(counted);
    auto& object = about.object;
    object["format"] = extension_of(options.file);
    object["size"] = {picture.width, picture.height};
    object["srgb_encoded"] = read.was_encoded;
    object["alpha"] = read.had_alpha;
    object["min"] = low;
    object["max"] = high;
    object["mean"] = {sum[0], sum[1], sum[2]};
    object["wavelengths_nm"] = picture.wavelengths_nm;
    about.notes = read.notes;
    if (!read.not_photometric.empty())
        about.notes.push_back(read.not_photometric + ": the picture is not photometric");
    object["encoding"] = read.encoding;
    about.lines.push_back(fmt::format("{}: picture, {} x {} pixels, {}{}", options.file.string(),
                                      picture.width, picture.height, read.encoding,
                                      read.had_alpha ? ", with alpha" : ""));
    about.lines.push_back(fmt::format("linear values {:.4g} to {:.4g}, mean {:.4g} {:.4g} {:.4g}",
                                      low, high, sum[0], sum[1], sum[2]));
    if (!picture.wavelengths_nm.empty()) {
        about.lines.push_back(
            fmt::format("{} spectral planes, {:g} to {:g} nm", picture.wavelengths_nm.size(),
                        picture.wavelengths_nm.front(), picture.wavelengths_nm.back()));
    }
    if (not_finite > 0) {
        about.faults.push_back(
            {FaultKind::not_finite,
             fmt::format("{} pixels hold values that are not finite; the first is pixel {},{}",
                         not_finite, first_of_them % static_cast<std::size_t>(picture.width),
                         first_of_them / static_cast<std::size_t>(picture.width))});
    }
    return about;
}

}  // namespace culet
