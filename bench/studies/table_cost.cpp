#include "bench/studies/table_cost.h"

#include <algorithm>
#include <cmath>

#include "render/raytable/relighting.h"
#include "render/raytable/table_maker.h"
#include "render/render.h"
#include "tests/cpu_time.h"

namespace culet {

TableCost table_cost(const Scene& given) {
    Scene scene = given;
    scene.settings.samples = scene.settings.threads = 1;
    scene.settings.check = Check::none;
    TableCost cost;
    const Clocks start = clocks();
    const TableRays rays = table_rays(scene);
    const RayTable table = make_ray_table(scene, rays, {});
    cost.make_seconds = clocks().cpu - start.cpu;
    cost.hits = static_cast<long long>(table.header().hits);
    cost.exits = static_cast<long long>(table.header().exits);
    cost.bytes = static_cast<double>(table.bytes());
    cost.relight_seconds =
        quickest([&] { cost.picture = relit(table, scene, rays, {}).picture; }, 3, 0.1).cpu;
    scene.settings.engine = k_reference_engine;
    Picture traced;
    cost.reference_seconds = quickest([&] { traced = render(scene).picture; }, 1, 0).cpu;
    float brightest = 0, worst = 0;
    for (std::size_t i = 0; i < traced.rgb.size(); ++i) {
        brightest = std::max(brightest, traced.rgb[i]);
        worst = std::max(worst, std::abs(traced.rgb[i] - cost.picture.rgb[i]));
    }
    cost.difference = static_cast<double>(worst) / static_cast<double>(brightest);
    return cost;
}

}  // namespace culet
