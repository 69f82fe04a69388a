// The engine "raytable": what the reference sees, by way of a ray table.

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <system_error>

#include "render/engine/engine.h"
#include "render/raytable/ray_table.h"
#include "render/raytable/relighting.h"
#include "render/raytable/table_key.h"
#include "render/raytable/table_maker.h"
#include "render/raytable/view_interpolation.h"
#include "render/setup/scene_checks.h"
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
    bool kept = false;  // it was there
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
    return {std::move(table), std::move(rays), true};
}

// Read where there is one, else made, and written where it has a file.
FittingTable table_in(const std::filesystem::path& file, const Scene& scene,
                      const Progress& progress) {
    std::error_code error;
    if (!file.empty() && std::filesystem::exists(file, error)) return kept_table(file, scene);
    require_writable(file);
    TableRays rays = table_rays(scene);
    RayTable table = make_ray_table(scene, rays, progress);
    if (!file.empty()) table.write(file);
    return {std::move(table), std::move(rays), false};
}

// Between the views about it, whose tables stand in a folder.
FittingTable table_between(const std::filesystem::path& folder, const Scene& scene,
                           const Progress& progress) {
    const std::vector<StoredView> views = stored_views(scene.camera, scene.settings.view_step);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    for (const StoredView& view : views) {
        if (!std::filesystem::exists(folder / view.name, error))
            require_writable(folder / view.name);
    }
    std::vector<ViewTable> tables;
    TableRays rays;
    const double parts = static_cast<double>(views.size()) + 1;
    const auto part = [&](std::size_t number) -> Progress {
        if (!progress) return {};
        return [&progress, parts, number](double fraction) {
            return progress((static_cast<double>(number) + fraction) / parts);
        };
    };
    for (const StoredView& view : views) {
        Scene seen = scene;
        seen.camera = view.camera;
        FittingTable found = table_in(folder / view.name, seen, part(tables.size()));
        rays = std::move(found.rays);
        tables.push_back({view, std::move(found.table)});
    }
    RayTable table = interpolated(scene, rays, tables, part(tables.size()));
    return {std::move(table), std::move(rays), false};
}

class RayTableEngine : public Engine {
public:
    std::string name() const override { return k_raytable_engine; }
    std::string refuses(const Scene& scene, const OpticalSetup& setup) const override {
        return refused_by_table(scene, setup);
    }
    // Its paths are the reference's.
    double cost_ns(const DrawingWork& work) const override {
        return engine_named(k_reference_engine).cost_ns(work);
    }
    // Fresnel factors and lengths are the reference's; what is cut does not know the lights.
    bool approaches_truth() const override { return false; }

    RenderResult draw(const Scene& scene, const Progress& progress) const override {
        const auto start = std::chrono::steady_clock::now();
        require_renderable(scene);
        if (const std::string why = refused_by_table(scene, make_optical_setup(scene));
            !why.empty())
            throw InputError(why + ": say engine = \"reference\"");
        const RenderSettings& settings = scene.settings;
        const bool between = !settings.ray_views.empty();
        if (between && (settings.reflection_factor || settings.transmission_factor)) {
            throw InputError(
                "reflection_factor and transmission_factor are for tables of the view "
                "itself: leave out --views");
        }
        const FittingTable fitting = between ? table_between(settings.ray_views, scene, progress)
                                             : table_in(settings.ray_table, scene, progress);
        const double ready = seconds_since(start);
        RenderResult result =
            relit(fitting.table, scene, fitting.rays, fitting.kept ? progress : Progress());
        RenderStats& stats = result.stats;
        (fitting.kept ? stats.seconds_setup : stats.seconds_build) = ready;
        stats.seconds_shade = seconds_since(start) - ready;
        if (between) {
            // What lies between two ways through the stone has no bound.
            stats.error_bound = std::numeric_limits<double>::quiet_NaN();
            stats.notes.push_back(
                fmt::format("between views in steps of {:g} radians: nobody knows how near",
                            settings.view_step));
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
