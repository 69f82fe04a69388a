#include "render/raytable/table_key.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/scene/fingerprint.h"
#include "stone/design/design.h"

namespace culet {

namespace {

TableKey key_of(const Fingerprint& print) {
    const std::string hex = print.hex();
    TableKey key{};
    std::copy_n(hex.begin(), std::min(hex.size(), key.size()), key.begin());
    return key;
}

// The shape only; names do not matter.
TableKey stone_key(const Stone& stone) {
    Fingerprint print;
    print.add(stone.convex ? 1 : 0);
    print.add(static_cast<int>(stone.unit));
    for (const Facet& facet : stone.solid.facets) {
        print.add(facet.plane.normal);
        print.add(facet.plane.offset);
        for (const int corner : facet.corners)
            print.add(stone.solid.vertices[static_cast<std::size_t>(corner)]);
    }
    return key_of(print);
}

TableKey optics_key(const TableRays& rays) {
    Fingerprint print;
    print.add(rays.limits.polarised ? 1 : 0);
    for (const Band& band : rays.bands) {
        print.add(band.n);
        print.add(band.n_outside);
        print.add(band.two_waves ? 1 : 0);
        if (!band.two_waves) continue;
        for (const Vec3& axis : band.crystal.axes()) print.add(axis);
        for (const double n : band.crystal.n()) print.add(n);
    }
    return key_of(print);
}

TableKey view_key(const Camera& camera) {
    Fingerprint print;
    print.add(camera.position);
    print.add(camera.look_at);
    print.add(camera.up);
    print.add(camera.orthographic_width || camera.cone ? 0 : camera.fov);
    print.add(camera.orthographic_width.value_or(-1));
    print.add(camera.cone.value_or(-1));
    for (const double c : line_of_sight_in(camera)) print.add(c);
    print.add(camera.aperture_radius);
    print.add(camera.aperture_radius > 0 ? camera.focus_distance : 0);
    return key_of(print);
}

TableKey rays_key(const Scene& scene, const TableRays& rays) {
    Fingerprint print;
    print.add(static_cast<int>(scene.settings.filter));
    print.add(scene.settings.filter_radius);
    print.add(rays.setup.on(Effects::aperture) ? 1 : 0);
    print.add(rays.limits.cut_weight);
    print.add(rays.limits.split_weight);
    // In branching trees the seed chooses branches.
    print.add(paths_branch(scene, rays.setup) ? static_cast<double>(rays.limits.seed) : 0.0);
    return key_of(print);
}

}  // namespace

TableRays table_rays(const Scene& scene, std::span<const double> wavelengths_nm) {
    TableRays rays;
    Scene named;
    const bool as_table = !wavelengths_nm.empty() && scene.settings.wavelengths_nm.empty();
    if (as_table) {
        named = scene;
        named.settings.wavelengths_nm.assign(wavelengths_nm.begin(), wavelengths_nm.end());
    }
    const RenderSettings& settings = scene.settings;
    rays.setup = make_optical_setup(as_table ? named : scene);
    const OpticalSetup& setup = rays.setup;
    rays.bands = setup.bands;
    // Without dispersion, several bands only reflect the tracer's list length and are alike.
    if (!setup.on(Effects::dispersion)) rays.bands.resize(1);
    rays.samples = settings.samples > 0 ? settings.samples : k_table_samples;
    PathLimits& limits = rays.limits;
    limits.depth = settings.depth > 0 ? settings.depth : k_deepest;
    limits.polarised = setup.polarised;
    limits.seed = settings.seed;
    if (settings.tolerance > 0) {
        // Unlike the reference, this does not know the lights. The single path in a convex stone
        // can be followed far.
        const double usual = paths_branch(scene, setup)
                                 ? k_table_cut
                                 : std::min(k_table_cut, 0.05 * settings.tolerance);
        limits.cut_weight = settings.cut_weight.value_or(usual);
        limits.split_weight = settings.split_weight.value_or(0);
    }
    return rays;
}

std::string refused_by_table(const Scene& scene, const OpticalSetup& setup) {
    if (!scene.has_stone()) return "a ray table is of a stone, and the scene has none";
    if (const std::string frosted = frosted_tiers(scene.stone.solid); !frosted.empty())
        return fmt::format(
            "a ray table holds no scattered light, and facets are frosted (tiers {})", frosted);
    if (setup.stokes && !scene.settings.spectral && !polarised(scene.lights) &&
        !scene.camera.optics.analyzer)
        return "a ray table holds no light that polished metal, glass or another stone polarises "
               "(effects without \"polarization\" leave that out)";
    if (scene.camera.optics.two_windows) return "a ray table has one window, a dichroscope two";
    if (scene.camera.optics.analyzer) return "a ray table holds no analyser before the eye";
    if (polarised(scene.lights)) return "a ray table holds no polarised lights";
    if (setup.on(Effects::coherence))
        return "a ray table adds the powers of a crystal's two waves and lets none interfere";
    if (scene.stone.solid.facets.size() > 65535) return "a ray table holds up to 65535 facets";
    const double samples = scene.settings.samples > 0 ? scene.settings.samples : k_table_samples;
    if (samples > 65535 || samples * scene.camera.width * scene.camera.height > 4294967295.0)
        return "a ray table holds up to 65535 samples a pixel and 4294967295 rays";
    const bool factors = scene.settings.reflection_factor || scene.settings.transmission_factor;
    if (factors && paths_branch(scene, setup))
        return "reflection_factor and transmission_factor are for convex stones of one wave: the "
               "paths of others branch";
    if (factors && scene.immersion != 1)
        return "reflection_factor and transmission_factor are for stones in air";
    return {};
}

RayTableHeader keys_of(const Scene& scene, const TableRays& rays) {
    RayTableHeader header;
    header.width = static_cast<std::uint32_t>(scene.camera.width);
    header.height = static_cast<std::uint32_t>(scene.camera.height);
    header.samples = static_cast<std::uint32_t>(rays.samples);
    header.bands = static_cast<std::uint32_t>(rays.bands.size());
    header.depth = static_cast<std::uint32_t>(rays.limits.depth);
    header.branches = paths_branch(scene, rays.setup) ? 1 : 0;
    header.lengths = rays.setup.splits ? 3 : 1;
    header.stone = stone_key(scene.stone);
    header.optics = optics_key(rays);
    header.view = view_key(scene.camera);
    header.rays = rays_key(scene, rays);
    return header;
}

std::string difference_to(const RayTableHeader& table, const Scene& scene, const TableRays& rays) {
    const RayTableHeader own = keys_of(scene, rays);
    if (own.stone != table.stone) return "another stone";
    if (own.width != table.width || own.height != table.height) {
        return fmt::format("a picture of {} x {} pixels, this one has {} x {}", table.width,
                           table.height, own.width, own.height);
    }
    if (own.view != table.view) return "another view";
    if (own.bands != table.bands) {
        return fmt::format("{}, this scene asks for {}",
                           table.bands == 1 ? "one refractive index for all wavelengths"
                                            : fmt::format("{} wavelengths", table.bands),
                           own.bands == 1 ? "one index" : fmt::format("{}", own.bands));
    }
    if (own.optics != table.optics || own.lengths != table.lengths ||
        own.branches != table.branches)
        return "other refractive indices, axes or wavelengths, or with other effects";
    if (own.depth != table.depth) {
        return fmt::format("paths of depth {}, this scene asks for {}", table.depth, own.depth);
    }
    if (own.samples != table.samples) {
        return fmt::format("samples = {}, this scene asks for {}", table.samples, own.samples);
    }
    if (own.rays != table.rays)
        return "rays that are chosen otherwise (tolerance, cut_weight, "
               "split_weight, filter, seed)";
    return {};
}

}  // namespace culet
