#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "app/program/file_kinds.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "render/reference/probe.h"
#include "render/scene/scene_io.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

struct ProbeArguments {
    CommonOptions common;
    std::string scene, pixel, ray, json;
    int most = 20;
};

EyeRay ray_of(const ProbeArguments& options, const Scene& scene) {
    if (!options.pixel.empty()) {
        const auto xy = numbers_in(options.pixel, 2, 2, "--pixel is X,Y from the top left");
        if (xy[0] < 0 || xy[1] < 0 || xy[0] >= scene.camera.width || xy[1] >= scene.camera.height) {
            throw InputError(
                fmt::format("--pixel {}: the picture has {} x {} pixels, counted from 0",
                            options.pixel, scene.camera.width, scene.camera.height));
        }
        // Whole numbers mean the middle of that pixel.
        const auto middle = [](double v) { return v == std::floor(v) ? v + 0.5 : v; };
        return EyeRays(scene.camera).through(middle(xy[0]), middle(xy[1]));
    }
    const auto r =
        numbers_in(options.ray, 6, 6, "--ray is OX,OY,OZ,DX,DY,DZ: a point and a direction");
    const Vec3 direction{r[3], r[4], r[5]};
    if (!(glm::length(direction) > 0)) throw InputError("--ray: the direction must not be zero");
    return {{r[0], r[1], r[2]}, glm::normalize(direction)};
}

int run_probe(const ProbeArguments& options) {
    if (options.pixel.empty() == options.ray.empty()) {
        throw InputError("probe needs one of --pixel X,Y and --ray OX,OY,OZ,DX,DY,DZ");
    }
    require_kind(options.scene, {FileKind::scene}, "culet probe", options.common.set);
    Scene scene = read_scene(options.scene, options.common.set);
    scene.settings.seed = options.common.seed;
    const ProbeResult result =
        probe(scene, ray_of(options, scene), progress_line("probing", options.common.quiet));
    if (!options.json.empty()) {
        write_text(options.json, probe_json(result));
        if (options.json == "-") return exit_good;
    }
    if (!result.hit) {
        fmt::print("the ray misses the stone\n");
        return exit_good;
    }
    // The polarisation ellipse at the eye of unpolarised light along this path.
    fmt::print("{:>9}  {:<22} {:>9} {:>7} {:>7}  {}\n", "weight", "sees", "polarised", "azimuth",
               "ellipt.", "facets, wave between them: o, e; s slow, f fast; c both; a air");
    int shown = 0;
    for (const ProbedPath& path : result.paths) {
        if (shown++ == options.most) break;
        double weight = 0;
        for (double w : path.weight) weight += w / static_cast<double>(path.weight.size());
        std::string facets;
        for (std::size_t i = 0; i < path.facets.size(); ++i) {
            if (i > 0)
                facets += path.modes[i - 1] == 'i' ? " " : fmt::format(" -{}- ", path.modes[i - 1]);
            facets += safe_for(stdout, path.facets[i]);
        }
        const PolarisationEllipse ellipse = ellipse_of(path.stokes);
        fmt::print("{:>9.6f}  {:<22} {:>8.1f}% {:>7.1f} {:>7.1f}  {}\n", weight, path.light,
                   100 * ellipse.degree, degrees(ellipse.azimuth), degrees(ellipse.ellipticity),
                   facets);
    }
    const auto mean = [](const std::vector<double>& values) {
        double sum = 0;
        for (double value : values) sum += value;
        return sum / static_cast<double>(values.size());
    };
    fmt::print("{} paths; radiance {:.6g}, not followed {:.3g}, absorbed {:.3g}, cut {:.3g}\n",
               result.paths.size(), mean(result.radiance), mean(result.remainder),
               mean(result.absorbed), mean(result.cut));
    return exit_good;
}

}  // namespace

void add_command_probe(CLI::App& program, int& exit_code) {
    auto options = std::make_shared<ProbeArguments>();
    CLI::App* command = program.add_subcommand(
        "probe", "the light paths behind one pixel: which facets make this flash");
    command->add_option("scene", options->scene, "scene file (TOML)")
        ->required()
        ->type_name("SCENE.toml");
    command->add_option("--pixel", options->pixel, "pixel, from the top left")->type_name("X,Y");
    command->add_option("--ray", options->ray, "origin and direction")
        ->type_name("OX,OY,OZ,DX,DY,DZ");
    command->add_option("--json", options->json, "all of it, unrounded (- is stdout)")
        ->type_name("FILE");
    command->add_option("--most", options->most, "paths shown, heaviest first")->type_name("N");
    add_common(*command, options->common, true);
    command->footer(
        "Examples:\n"
        "  culet probe scene.toml --pixel 200,180\n"
        "  culet probe scene.toml --ray 0,0,40,0,0,-1 --json - --set render.depth=8 --set "
        "render.tolerance=0");
    command->callback([options, &exit_code] { exit_code = run_probe(*options); });
}

}  // namespace culet
