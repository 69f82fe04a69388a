#pragma once
// Scenes for tests of ray tables, and how their pictures compare.

#include <algorithm>
#include <cmath>

#include "render/engine/engine.h"
#include "render/raytable/relighting.h"
#include "render/raytable/table_maker.h"
#include "render/setup/optical_setup.h"
#include "stone/material/material_io.h"
#include "stone/text/errors.h"
#include "tests/render/bench_scenes.h"
#include "tests/render/carved_solids.h"

namespace culet::test {

/// The round brilliant of bench_scenes.h in diamond: depth 6, one wavelength, polarised, one ray
/// per pixel, nothing pruned.
inline Scene brilliant(int pixels = 48) {
    Scene scene = base_scene(pixels);
    set_polarised(scene, true);
    scene.settings.depth = 6;
    scene.settings.samples = 1;
    scene.settings.effects[static_cast<std::size_t>(Effects::coherence)] = false;
    return scene;
}

inline Scene in_material(Scene scene, const std::string& name) {
    scene.stone.material = catalogue_material(name);
    return scene;
}

inline Scene with_solid(Scene scene, const Solid& solid, bool convex) {
    scene.stone.solid = solid;
    scene.stone.convex = convex;
    scene.camera = bench_camera(solid, 6, bench_view(), scene.camera.width);
    return scene;
}

inline RayTable table_of(const Scene& scene) {
    return make_ray_table(scene, table_rays(scene), {});
}

inline RenderResult relit_by(const RayTable& table, const Scene& scene,
                             ExitPrecision precision = ExitPrecision::fastest) {
    const TableRays rays = table_rays(scene, table.parts().wavelengths_nm);
    const std::string other = difference_to(table.header(), scene, rays);
    if (!other.empty()) throw InternalError("the table does not fit: " + other);
    return relit(table, scene, rays, {}, precision);
}

inline RenderResult by_reference(Scene scene) {
    scene.settings.engine = k_reference_engine;
    return engine_of(scene.settings).draw(scene, {});
}

struct Apart {
    double worst = 0;      ///< largest difference of a value
    double mean = 0;       ///< mean difference over the stone's pixels, relative to their mean
    double brightest = 0;  ///< of the second picture
};

inline Apart apart(const Picture& picture, const Picture& truth) {
    Apart apart;
    double sum = 0, whole = 0;
    for (std::size_t i = 0; i < truth.rgb.size(); ++i) {
        const double value = static_cast<double>(truth.rgb[i]);
        const double off = std::abs(static_cast<double>(picture.rgb[i]) - value);
        apart.worst = std::max(apart.worst, off);
        apart.brightest = std::max(apart.brightest, value);
        if (truth.coverage[i / 3] > 0) {
            sum += off;
            whole += value;
        }
    }
    apart.mean = whole > 0 ? sum / whole : 0;
    return apart;
}

}  // namespace culet::test
