#include <fmt/format.h>

#include "app/describe.h"
#include "render/scene_io.h"
#include "stone/errors.h"
#include "stone/units.h"

namespace culet {

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
                        {"constant", lights.constant},
                        {"spheres", lights.spheres.size()},
                        {"lobes", lights.lobes.size()},
                        {"hemispheres", lights.hemispheres.size()},
                        {"caps", lights.caps.size()},
                        {"planes", lights.planes.size()}};
    object["engine"] = scene.settings.engine;
    object["depth"] = scene.settings.depth;
    object["tolerance"] = scene.settings.tolerance;
    about.lines.push_back(fmt::format("{}: scene, {} x {} pixels, stone \"{}\"",
                                      options.file.string(), camera.width, camera.height,
                                      scene.stone.name));
    about.lines.push_back(
        fmt::format("lights: {}{} spheres, {} lobes, {} hemispheres, {} caps, {} planes",
                    lights.environment ? "an environment, "
                                       : (lights.constant > 0 ? "a constant environment, " : ""),
                    lights.spheres.size(), lights.lobes.size(), lights.hemispheres.size(),
                    lights.caps.size(), lights.planes.size()));
    describe_material(scene.stone.material, about);
    describe_solid(scene.stone.solid, scene.stone.convex && !options.may_be_concave,
                   options.facet_table, about);
    return about;
}

Description describe_image_file(const DescribeOptions& options) {
    throw InputError(options.file, "is a picture: pictures are not described yet");
}

}  // namespace culet
