#include "bench/studies/cube_map_light.h"

#include "bench/frame_time.h"
#include "bench/studies/scenes.h"
#include "render/beams/frame_renderer.h"
#include "render/reference/light_field.h"
#include "render/scene/environment_layout.h"

namespace culet {

EnvironmentMap light_at_origin(const Lights& lights, int width) {
    // One wavelength: one radiance for all colours.
    const LightField field(lights, WavelengthSet({540}));
    EnvironmentMap map;
    map.width = width;
    map.height = width / 2;
    for (int row = 0; row < map.height; ++row) {
        for (int column = 0; column < map.width; ++column) {
            double radiance = 0;
            field.add_radiance(Vec3{0},
                               lat_long_direction(column + 0.5, row + 0.5, map.width, map.height),
                               1, 0, 1, &radiance);
            map.rgb.insert(map.rgb.end(), 3, static_cast<float>(radiance));
        }
    }
    return map;
}

Lights windows_at(double distance) {
    Lights lights;
    lights.constant = 0.1;
    for (const double side : {-1.0, 1.0}) {
        PlaneLight window;
        window.point = distance * Vec3{0.6 * side, 0.2, 1};
        window.normal = {0, 0, -1};
        window.u = distance * Vec3{0.35, 0, 0};
        window.v = distance * Vec3{0, 0.35, 0};
        window.radiance = {3.0};
        lights.sources.push_back(window);
    }
    return lights;
}

double cube_map_error(const Scene& given, const Lights& lights, int map_width) {
    Scene scene = drawn_as(given, Drawing::averaged, 0);
    scene.lights = lights;
    const Picture truth = FrameRenderer(scene).draw().picture;
    Lights mapped;
    mapped.environment = std::make_shared<EnvironmentMap>(light_at_origin(lights, map_width));
    scene.lights = mapped;
    return mean_difference(FrameRenderer(scene).draw().picture, truth);
}

}  // namespace culet
