#include "render/export/mitsuba.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>

#include "render/export/scene_writer.h"
#include "render/scene/surface_colour.h"
#include "render/setup/scene_checks.h"

namespace culet {

namespace {

constexpr int k_map_height = 512;
constexpr int k_usual_samples = 64;

std::string point(const Vec3& v) {
    return fmt::format("{}, {}, {}", v.x, v.y, v.z);
}
std::string rgb(const char* name, const Rgb& c) {
    return fmt::format(R"(<rgb name="{}" value="{}, {}, {}"/>)", name, c[0], c[1], c[2]);
}
// A matrix with these columns, written row by row.
std::string matrix(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& at) {
    return fmt::format(
        R"(<transform name="to_world"><matrix value="{} {} {} {} {} {} {} {} {} {} {} {} 0 0 0 1"/></transform>)",
        x.x, y.x, z.x, at.x, x.y, y.y, z.y, at.y, x.z, y.z, z.z, at.z);
}
// Transforms a square or disc of half side or radius 1 to `size`, facing along `normal`.
std::string turned_to(const Vec3& normal, double size, const Vec3& at) {
    const auto [u, v] = in_plane(normal);
    return matrix(size * u, size * v, normal, at);
}
std::string obj_text(const TriangleMesh& mesh) {
    std::string text;
    const auto out = std::back_inserter(text);
    for (const Vec3& v : mesh.vertices) fmt::format_to(out, "v {} {} {}\n", v.x, v.y, v.z);
    for (const auto& t : mesh.triangles)
        fmt::format_to(out, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    return text;
}

// For one axis of the picture: a larger film centred on the line of sight.
struct FilmCut {
    int film = 0, offset = 0;
    double lost = 0;  // distance in pixels between the line of sight and the film's centre
};
FilmCut film_cut(double sight, int pixels) {
    const int twice = static_cast<int>(std::lround(2 * sight));
    FilmCut cut;
    cut.film = std::max(twice, 2 * pixels - twice);
    cut.offset = twice >= pixels ? 0 : pixels - twice;
    cut.lost = std::abs(sight - 0.5 * twice);
    return cut;
}

class MitsubaWriter : SceneWriter {
public:
    MitsubaWriter(const Scene& scene, std::string stem)
        : SceneWriter(scene), stem_(std::move(stem)) {}

    ExportedScene write() {
        line(R"(<?xml version="1.0" encoding="utf-8"?>)");
        line("<!-- mitsuba -m scalar_rgb THIS.xml; lengths are the stone's -->");
        line(R"(<scene version="3.0.0">)");
        integrator();
        camera();
        distant_lights();
        everything_by(*this);
        for (const std::string& note : result_.notes) line("  <!-- Not carried: {} -->", note);
        line("</scene>");
        return std::move(result_);
    }

private:
    void integrator() {
        note_left_out(scene_, result_.notes);
        line(R"(  <integrator type="volpath"><integer name="max_depth" value="{}"/></integrator>)",
             scene_.settings.depth > 0 ? scene_.settings.depth + 1 : -1);
    }

    void camera() {
        const Camera& camera = scene_.camera;
        const bool parallel = camera.orthographic_width.has_value();
        // Mitsuba's line of sight is in the middle: use a larger film and crop the picture from it.
        const auto [sight_x, sight_y] = line_of_sight_in(camera);
        const FilmCut x = film_cut(sight_x, camera.width), y = film_cut(sight_y, camera.height);
        if (x.lost + y.lost > 1e-3) note("the place of the principal point within half a pixel");
        line(R"(  <sensor type="{}">)", parallel ? "orthographic" : "perspective");
        if (!parallel) {
            const double tangent = std::tan(camera.fov / 2) * y.film / camera.height;
            line(R"(    <string name="fov_axis" value="y"/><float name="fov" value="{}"/>)",
                 degrees(2 * std::atan(tangent)));
        }
        line(R"(    <float name="near_clip" value="{}"/><float name="far_clip" value="{}"/>)",
             1e-3 * size_, 10 * k_far_away * size_);
        line(R"(    <transform name="to_world">)");
        if (parallel) {
            const double half = *camera.orthographic_width * x.film / camera.width / 2;
            line(R"(      <scale x="{0}" y="{0}"/>)", half);
        }
        line(R"(      <lookat origin="{}" target="{}" up="{}"/>)", point(camera.position),
             point(camera.look_at), point(camera.up));
        line("    </transform>");
        line(
            R"(    <film type="hdrfilm"><integer name="width" value="{}"/><integer name="height" value="{}"/>)",
            x.film, y.film);
        if (x.film != camera.width || y.film != camera.height) {
            line(
                R"(      <integer name="crop_offset_x" value="{}"/><integer name="crop_offset_y" value="{}"/>)",
                x.offset, y.offset);
            line(
                R"(      <integer name="crop_width" value="{}"/><integer name="crop_height" value="{}"/>)",
                camera.width, camera.height);
        }
        line(R"(      <rfilter type="box"/></film>)");
        line(
            R"(    <sampler type="independent"><integer name="sample_count" value="{}"/></sampler>)",
            scene_.settings.samples > 0 ? scene_.settings.samples : k_usual_samples);
        line("  </sensor>");
    }

    void distant_lights() {
        const DistantLights lights(scene_.lights, lights_, result_.notes);
        if (lights.is_even()) {
            if (scene_.lights.constant > 0)
                line(R"(  <emitter type="constant"><float name="radiance" value="{}"/></emitter>)",
                     scene_.lights.constant);
            return;
        }
        // Mitsuba's map has +y up and its left edge at -z; y is rotated to z.
        const auto direction = [](double column, double row) {
            const double phi = std::numbers::pi * column / k_map_height;
            const double theta = std::numbers::pi * row / k_map_height;
            return Vec3{std::sin(phi) * std::sin(theta), std::cos(phi) * std::sin(theta),
                        std::cos(theta)};
        };
        const std::string name = stem_ + "-mitsuba-light.exr";
        result_.environment = {
            name, distant_light_map(lights, 2 * k_map_height, k_map_height, direction)};
        note_light_map(lights, 180.0 / k_map_height, result_.notes);
        line(R"(  <emitter type="envmap"><string name="filename" value="{}"/>)", name);
        line(R"(    {}</emitter>)", matrix({1, 0, 0}, {0, 0, 1}, {0, -1, 0}, Vec3(0)));
    }

    std::string glowing(const LightColour& light) {
        return R"(<bsdf type="diffuse"><rgb name="reflectance" value="0, 0, 0"/></bsdf>)"
               R"(<emitter type="area">)" +
               rgb("radiance", rgb_of_light(light)) + "</emitter>";
    }
    void near(const SphereLight& sphere) {
        const bool inside = glm::length(scene_.camera.position - sphere.center) < sphere.radius;
        line(
            R"(  <shape type="sphere"><point name="center" value="{}"/><float name="radius" value="{}"/>)",
            point(sphere.center), sphere.radius);
        line(R"(    <boolean name="flip_normals" value="{}"/>{}</shape>)", inside,
             glowing(sphere.radiance));
    }
    void near(const PlaneLight& plane) {
        note(k_black_behind);
        if (!plane.u || !plane.v) note(k_planes_end);
        const auto [u, v] = extent_of(plane, k_far_away * size_);
        line(R"(  <shape type="rectangle">{}{}</shape>)", matrix(u, v, plane.normal, plane.point),
             glowing(plane.radiance));
    }

    // Writes a mesh to its own file, without smooth normals.
    std::string mesh(const TriangleMesh& mesh) {
        const std::string name = fmt::format("{}-mitsuba-{}.obj", stem_, result_.meshes.size() + 1);
        result_.meshes.emplace_back(name, obj_text(mesh));
        return fmt::format(
            R"(<shape type="obj"><string name="filename" value="{}"/><boolean name="face_normals" value="true"/>)",
            name);
    }
    std::string dielectric(double index, const Rgb& absorption) const {
        std::string text = fmt::format(
            R"(<bsdf type="dielectric"><float name="int_ior" value="{}"/><float name="ext_ior" value="{}"/></bsdf>)",
            index, scene_.immersion);
        const double most = std::max({absorption[0], absorption[1], absorption[2]});
        if (!(most > 0)) return text;
        // Colours are limited to 1, so the largest value becomes the scale.
        const Rgb share{absorption[0] / most, absorption[1] / most, absorption[2] / most};
        return text + R"(<medium name="interior" type="homogeneous">)" + rgb("sigma_t", share) +
               R"(<rgb name="albedo" value="0, 0, 0"/>)" +
               fmt::format(R"(<float name="scale" value="{}"/></medium>)", most);
    }
    void stone(const Stone& stone) {
        const StoneOptics optics = optics_of(stone, scene_, result_.notes);
        if (optics.disperses)
            note(fmt::format("dispersion: the index at {} nm is written", optics.index_nm));
        line("  {}", mesh(triangles_of(drawn_solid(stone))));
        line("    {}</shape>", dielectric(optics.index, optics.absorption));
    }

    std::string shape(const SphereShape& s) {
        return fmt::format(
            R"(<shape type="sphere"><point name="center" value="{}"/><float name="radius" value="{}"/>)",
            point(s.center), s.radius);
    }
    std::string shape(const PlaneShape& s) {
        note(k_planes_end);
        return R"(<shape type="rectangle">)" + turned_to(s.normal, k_far_away * size_, s.point);
    }
    std::string shape(const DiscShape& s) {
        return R"(<shape type="disk">)" + turned_to(s.normal, s.radius, s.center);
    }
    std::string shape(const BoxShape& s) { return mesh(triangles_of(s)); }
    std::string shape(const MeshShape& s) { return mesh(*s.mesh); }

    // Open surfaces reflect on both sides.
    static std::string two_sided(const std::string& bsdf) {
        return R"(<bsdf type="twosided">)" + bsdf + "</bsdf>";
    }
    std::string surface(const DiffuseMaterial& m) {
        return two_sided(R"(<bsdf type="diffuse">)" + rgb("reflectance", rgb_of(m.albedo)) +
                         "</bsdf>");
    }
    std::string surface(const MetalMaterial& m) {
        const MetalIndex index = finite_index_of(m);
        const std::string alpha = m.roughness > 0
                                      ? fmt::format(R"(<float name="alpha" value="{}"/>)"
                                                    R"(<string name="distribution" value="ggx"/>)",
                                                    m.roughness * m.roughness)
                                      : std::string();
        return two_sided(fmt::format(R"(<bsdf type="{}">{}{}{}</bsdf>)",
                                     m.roughness > 0 ? "roughconductor" : "conductor",
                                     rgb("eta", index.n), rgb("k", index.k), alpha));
    }
    std::string surface(const MirrorMaterial& m) {
        return two_sided(R"(<bsdf type="conductor"><string name="material" value="none"/>)" +
                         rgb("specular_reflectance", rgb_of(m.albedo)) + "</bsdf>");
    }
    std::string surface(const DielectricMaterial& m) {
        return dielectric(m.index, rgb_of(m.absorption));
    }
    std::string surface(const EmitterMaterial& m) { return glowing(m.radiance); }

    void object(const SceneObject& object) {
        const std::string text = std::visit([&](const auto& s) { return shape(s); }, object.shape);
        line("  {}", text);
        line("    {}</shape>",
             std::visit([&](const auto& m) { return surface(m); }, object.material));
    }

    friend SceneWriter;
    std::string stem_;
};

}  // namespace

ExportedScene mitsuba_scene(const Scene& scene, const std::string& stem) {
    require_renderable(scene);
    refuse_instruments(scene, "Mitsuba");
    return MitsubaWriter(scene, plain_stem(stem)).write();
}

}  // namespace culet
