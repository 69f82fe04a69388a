// The engine "raytable": the reference's picture by way of a ray table.

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
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct FittingTable {
    RayTable table;
    TableRays rays;
    bool kept = false;  // read from the file
};

FittingTable kept_table(const std::filesystem::path& file, const Scene& scene) {
    RayTable table = RayTable::open(file);
    TableRays rays = table_rays(scene, table.parts().wavelengths_nm);
    const std::string other = difference_to(table.header(), scene, rays);
    if (!other.empty()) {
        throw InputError(
            file,
            fmt::format(
                "is a ray table of {}: name another file, or delete this one to have it made again",
                other));
    }
    return {std::move(table), std::move(rays), true};
}

// Reads the table if the file exists; else makes it, and writes it if a file is named.
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

class RayTableEngine : public Engine {
public:
    std::string name() const override { return k_raytable_engine; }
    std::string refuses(const Scene& scene, const OpticalSetup& setup) const override {
        return refused_by_table(scene, setup);
    }
    double cost_ns(const DrawingWork& work) const override {
        return engine_named(k_reference_engine).cost_ns(work);
    }
    // Paths are the reference's, but cuts by weight do not take the lights into account.
    bool approaches_truth() const override { return false; }

    RenderResult draw(const Scene& scene, const Progress& progress) const override {
        const auto start = std::chrono::steady_clock::now();
        require_renderable(scene);
        if (const std::string why = refused_by_table(scene, make_optical_setup(scene));
            !why.empty())
            throw InputError(why + ": say engine = \"reference\"");
        const FittingTable fitting = table_in(scene.settings.ray_table, scene, progress);
        const double ready = seconds_since(start);
        RenderResult result =
            relit(fitting.table, scene, fitting.rays, fitting.kept ? progress : Progress());
        RenderStats& stats = result.stats;
        (fitting.kept ? stats.seconds_setup : stats.seconds_build) = ready;
        stats.seconds_shade = seconds_since(start) - ready;
        for (std::string& note : notes_on_drawing(scene)) stats.notes.push_back(note);
        return result;
    }
};

}  // namespace

const Engine& raytable_engine() {
    static const RayTableEngine engine;
    return engine;
}

}  // namespace culet
