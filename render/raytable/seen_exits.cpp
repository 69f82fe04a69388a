#include "render/raytable/seen_exits.h"

#include "render/raytable/octahedral_codes.h"
#include "render/raytable/table_maker.h"

namespace culet {

void visit_exits(const Scene& scene, const std::function<void(const SeenExit&)>& visit) {
    const RayTable table = make_ray_table(scene, table_rays(scene), {});
    const RayTableParts<TableSpan>& parts = table.parts();
    std::size_t exit = 0;
    for (std::size_t hit = 0; hit < parts.hit_ray.size(); ++hit) {
        for (; exit < parts.exits_end[hit]; ++exit)
            visit({parts.hit_ray[hit],
                   octahedral_direction({parts.direction[0][exit], parts.direction[1][exit]}),
                   double(parts.weight[exit])});
    }
}

}  // namespace culet
