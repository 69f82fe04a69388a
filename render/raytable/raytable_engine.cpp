// The engine "raytable": what the reference sees, by way of a ray table.

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <system_error>

#include "render/engine/engine.h"
#include "render/raytable/ray_table.h"
#include "render/raytable/relighting.h"
#include "render/raytable/table_key.h"
#include "render/raytable/table_maker.h"
#include "render/setup/scene_checks.h"
#include "render/work/price.h"
#include "stone/errors.h"
#include "stone/output_file.h"

namespace culet {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// A table, and the rays of the scene that fit it.
struct FittingTable {
    RayTable table;
    TableRays rays;
};

FittingTable kept_table(const std::filesystem::path& file, const Scene& scene) {
    RayTable table = RayTable::open(file);
    TableRays rays = table_rays(scene, table.parts().wavelengths_nm);
    const std::string other = difference_to(table.header(), scene, rays);
    if (!other.empty()) {
        throw InputError(file, fmt::format("is a ray table of {}: name another file, or delete "
                                           "this one, and it is made anew",
                                           other));
    }
    return {std::move(table), std::move(rays)};
}

class RayTableEngine : public Engine {
public:
    std::string name() const override { return k_raytable_engine; }
    std::string refuses(const Scene& scene, const OpticalSetup& setup) const override {
        return refused_by_table(scene, setup);
    }
    double cost_ns(const DrawingWork& work) const override {
        PathWork paths;
        paths.rays = work.pixels * work.views * work.bands;
        paths.events = paths.rays * work.faces_per_ray;
        paths.general = work.general;
        paths.polarised = work.polarised;
        paths.nodes = work.nodes;
        return price_ns(paths);
    }
    // Fresnel factors and lengths are the reference's; what is cut does not know the lights.
    bool approaches_truth() const override { return false; }

    RenderResult draw(const Scene& scene, const Progress& progress) const override {
        const auto start = std::chrono::steady_clock::now();
        require_renderable(scene);
        if (const std::string why = refused_by_table(scene, make_optical_setup(scene));
            !why.empty())
            throw InputError(why + ": say engine = \"reference\"");
        const std::filesystem::path file = scene.settings.ray_table;
        std::error_code error;
        const bool kept = !file.empty() && std::filesystem::exists(file, error);
        if (!kept) require_writable(file);
        RenderResult result;
        const auto relight = [&](const FittingTable& fitting) {
            const double before = seconds_since(start);
            result = relit(fitting.table, scene, fitting.rays, kept ? progress : Progress());
            result.stats.seconds_shade = seconds_since(start) - before;
        };
        if (kept) {
            const FittingTable fitting = kept_table(file, scene);
            const double setup = seconds_since(start);
            relight(fitting);
            result.stats.seconds_setup = setup;
        } else {
            TableRays rays = table_rays(scene);
            const double setup = seconds_since(start);
            RayTable table = make_ray_table(scene, rays, progress);
            if (!file.empty()) table.write(file);
            const double build = seconds_since(start) - setup;
            relight({std::move(table), std::move(rays)});
            result.stats.seconds_setup = setup;
            result.stats.seconds_build = build;
        }
        for (std::string& note : notes_on_drawing(scene)) result.stats.notes.push_back(note);
        return result;
    }
};

}  // namespace

const Engine& raytable_engine() {
    static const RayTableEngine engine;
    return engine;
}

}  // namespace culet
