#include "render/export/pbrt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>

#include "render/export/scene_writer.h"
#include "render/scene/surface_colour.h"
#include "render/setup/scene_checks.h"
#include "stone/export/mean_material.h"

namespace culet {

namespace {

constexpr int k_map_side = 1024;
constexpr int k_pbrt_depth = 100;
constexpr int k_pbrt_samples = 256;
// PBRT samples from 360 to 830 nm and uses 0 where a spectrum has no value; culet's wavelengths are
// from 380 to 780.
constexpr double k_pbrt_first_nm = 360, k_pbrt_last_nm = 830, k_pbrt_step_nm = 10;
constexpr double k_first_seen_nm = 380, k_last_seen_nm = 780;

std::string numbers(const Vec3& v) {
    return fmt::format("{} {} {}", v.x, v.y, v.z);
}
std::string numbers(const Rgb& c) {
    return fmt::format("{} {} {}", c[0], c[1], c[2]);
}
// Writes "spectrum NAME" with a value at each wavelength.
template <class At>
std::string spectrum(const char* name, const At& at) {
    std::string text = fmt::format("\"spectrum {}\" [", name);
    for (double nm = k_pbrt_first_nm; nm <= k_pbrt_last_nm; nm += k_pbrt_step_nm) {
        const double known = std::clamp(nm, k_first_seen_nm, k_last_seen_nm);
        text += fmt::format(" {} {}", nm, at(known));
    }
    return text + " ]";
}
std::string triangle_mesh(const TriangleMesh& mesh) {
    std::string text = "Shape \"trianglemesh\" \"point3 P\" [";
    const auto out = std::back_inserter(text);
    for (const Vec3& v : mesh.vertices) fmt::format_to(out, "\n    {}", numbers(v));
    text += " ]\n    \"integer indices\" [";
    for (const auto& t : mesh.triangles) fmt::format_to(out, "\n    {} {} {}", t[0], t[1], t[2]);
    return text + " ]";
}
// It faces along u x v.
std::string rectangle(const Vec3& middle, const InPlane& half) {
    const auto& [u, v] = half;
    TriangleMesh mesh;
    mesh.vertices = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return triangle_mesh(mesh);
}

class PbrtWriter : SceneWriter {
public:
    PbrtWriter(const Scene& scene, std::string stem) : SceneWriter(scene), stem_(std::move(stem)) {}

    ExportedScene write() {
        line("# pbrt THIS.pbrt (version 4); lengths are the stone's");
        note_left_out(scene_, result_.notes);
        camera();
        line("WorldBegin");
        distant_lights();
        everything_by(*this);
        for (const std::string& note : result_.notes) line("# Not carried: {}", note);
        return std::move(result_);
    }

private:
    void camera() {
        const Camera& camera = scene_.camera;
        const RenderSettings& settings = scene_.settings;
        const bool parallel = camera.orthographic_width.has_value();
        // PBRT's camera uses a left-handed frame: mirror x.
        line("Scale -1 1 1");
        line("LookAt {}  {}  {}", numbers(camera.position), numbers(camera.look_at),
             numbers(camera.up));
        // Side of a pixel, as a length or a tangent: the window of 90 degrees is in tangents.
        const double side = parallel ? *camera.orthographic_width / camera.width
                                     : 2 * std::tan(camera.fov / 2) / camera.height;
        const auto [sight_x, sight_y] = line_of_sight_in(camera);
        line("Camera \"{}\"{} \"float screenwindow\" [ {} {} {} {} ]",
             parallel ? "orthographic" : "perspective", parallel ? "" : " \"float fov\" [ 90 ]",
             -sight_x * side, (camera.width - sight_x) * side, (sight_y - camera.height) * side,
             sight_y * side);
        line(
            "Film \"rgb\" \"string filename\" [ \"{}.exr\" ] \"integer xresolution\" [ {} ] "
            "\"integer yresolution\" [ {} ]",
            stem_, camera.width, camera.height);
        line("PixelFilter \"box\"");
        line("Sampler \"independent\" \"integer pixelsamples\" [ {} ]",
             settings.samples > 0 ? settings.samples : k_pbrt_samples);
        line("Integrator \"volpath\" \"integer maxdepth\" [ {} ]",
             settings.depth > 0 ? settings.depth : k_pbrt_depth);
    }

    void distant_lights() {
        const DistantLights lights(scene_.lights, lights_, result_.notes);
        if (lights.is_even()) {
            if (scene_.lights.constant > 0)
                line("LightSource \"infinite\" \"rgb L\" [ {0} {0} {0} ]", scene_.lights.constant);
            return;
        }
        const std::string name = stem_ + "-pbrt-light.exr";
        result_.environment = {
            name, distant_light_map(lights, k_map_side, k_map_side, [](double column, double row) {
                return equal_area_direction(column / k_map_side, row / k_map_side);
            })};
        // All texels have the same solid angle.
        const double texel = std::sqrt(4 * std::numbers::pi) / k_map_side;
        note_light_map(lights, degrees(texel), result_.notes);
        line("LightSource \"infinite\" \"string filename\" [ \"{}\" ]", name);
    }

    void begin() { line("AttributeBegin"); }
    void end() { line("AttributeEnd"); }

    void glow(const LightColour& light, bool both_sides) {
        line("  Material \"diffuse\" \"rgb reflectance\" [ 0 0 0 ]");
        line("  AreaLightSource \"diffuse\" \"rgb L\" [ {} ] \"bool twosided\" [ {} ]",
             numbers(rgb_of_light(light)), both_sides);
    }
    void near(const SphereLight& sphere) {
        begin();
        glow(sphere.radiance, true);
        shape(SphereShape{sphere.center, sphere.radius});
        end();
    }
    void near(const PlaneLight& plane) {
        note(k_black_behind);
        begin();
        glow(plane.radiance, false);
        if (!plane.u || !plane.v) note(k_planes_end);
        line("  {}", rectangle(plane.point, extent_of(plane, k_far_away * size_)));
        end();
    }

    // Defines a medium of this absorption inside the following shapes.
    void fill(const std::string& absorption) {
        ++media_;
        line("  MakeNamedMedium \"medium-{}\" \"string type\" \"homogeneous\"", media_);
        line("    {}", absorption);
        line("    \"rgb sigma_s\" [ 0 0 0 ]");
        line("  MediumInterface \"medium-{}\" \"\"", media_);
    }
    void stone(const Stone& stone) {
        begin();
        std::vector<std::string> of_rgb;  // ignored: PBRT gets the spectrum
        const StoneOptics optics = optics_of(stone, scene_, of_rgb);
        if (optics.birefringent) note("double refraction: the mean index is written");
        if (optics.pleochroic) note("pleochroism: the mean absorption is written");
        if (optics.disperses) {
            line("  Material \"dielectric\" {}", spectrum("eta", [&](double nm) {
                     return mean_index(stone.material, nm) / scene_.immersion;
                 }));
        } else {
            line("  Material \"dielectric\" \"float eta\" [ {} ]", optics.index / scene_.immersion);
        }
        if (optics.absorption != Rgb{}) {
            if (lights_.one_wavelength()) {
                fill(fmt::format("\"rgb sigma_a\" [ {} ]", numbers(optics.absorption)));
            } else {
                fill(spectrum("sigma_a", [&](double nm) {
                    return mm_per(stone.unit) * mean_absorption(stone.material, nm);
                }));
            }
        }
        line("  {}", triangle_mesh(triangles_of(drawn_solid(stone))));
        end();
    }

    void shape(const SphereShape& s) {
        line("  Translate {}", numbers(s.center));
        line("  Shape \"sphere\" \"float radius\" [ {} ]", s.radius);
    }
    void shape(const PlaneShape& s) {
        note(k_planes_end);
        line("  {}", rectangle(s.point, extent_of(PlaneLight{s.point, s.normal, {}, {}, {}},
                                                  k_far_away * size_)));
    }
    void shape(const DiscShape& s) {
        const auto [u, v] = in_plane(s.normal);
        line("  Transform [ {} 0  {} 0  {} 0  {} 1 ]", numbers(u), numbers(v), numbers(s.normal),
             numbers(s.center));
        line("  Shape \"disk\" \"float radius\" [ {} ]", s.radius);
    }
    void shape(const BoxShape& s) { line("  {}", triangle_mesh(triangles_of(s))); }
    void shape(const MeshShape& s) { line("  {}", triangle_mesh(*s.mesh)); }

    void surface(const DiffuseMaterial& m) {
        line("  Material \"diffuse\" \"rgb reflectance\" [ {} ]", numbers(rgb_of(m.albedo)));
    }
    void surface(const MetalMaterial& m) {
        const MetalIndex index = finite_index_of(m);
        line("  Material \"conductor\" \"rgb eta\" [ {} ] \"rgb k\" [ {} ]", numbers(index.n),
             numbers(index.k));
        line("    \"float roughness\" [ {} ] \"bool remaproughness\" [ false ]",
             m.roughness * m.roughness);
    }
    void surface(const MirrorMaterial& m) {
        note("mirrors of one reflectance at every angle: they reflect more at a slant");
        line("  Material \"conductor\" \"rgb reflectance\" [ {} ]", numbers(rgb_of(m.albedo)));
    }
    void surface(const DielectricMaterial& m) {
        line("  Material \"dielectric\" \"float eta\" [ {} ]", m.index / scene_.immersion);
        const Rgb absorption = rgb_of(m.absorption);
        if (absorption != Rgb{}) fill(fmt::format("\"rgb sigma_a\" [ {} ]", numbers(absorption)));
    }
    void surface(const EmitterMaterial& m) { glow(m.radiance, true); }

    void object(const SceneObject& object) {
        begin();
        std::visit([&](const auto& m) { surface(m); }, object.material);
        std::visit([&](const auto& s) { shape(s); }, object.shape);
        end();
    }

    friend SceneWriter;
    std::string stem_;
    int media_ = 0;
};

}  // namespace

Vec3 equal_area_direction(double x, double y) {
    const double u = 2 * x - 1, v = 2 * y - 1;
    const double to_edge = 1 - (std::abs(u) + std::abs(v));  // of the inner square, z = 0
    const double r = 1 - std::abs(to_edge);
    const double phi = (r == 0 ? 1 : (std::abs(v) - std::abs(u)) / r + 1) * std::numbers::pi / 4;
    const double level = r * std::sqrt(std::max(0.0, 2 - r * r));
    return {std::copysign(std::cos(phi), u) * level, std::copysign(std::sin(phi), v) * level,
            std::copysign(1 - r * r, to_edge)};
}

ExportedScene pbrt_scene(const Scene& scene, const std::string& stem) {
    require_renderable(scene);
    refuse_instruments(scene, "PBRT");
    return PbrtWriter(scene, plain_stem(stem)).write();
}

}  // namespace culet
