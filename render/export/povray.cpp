#include "render/export/povray.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>

#include "render/export/povray_objects.h"
#include "render/export/scene_writer.h"
#include "render/setup/optical_setup.h"
#include "render/setup/scene_checks.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// The stone's diameter in POV-Ray's units is from this to twice this. Then the hits nearer than
// 1e-4, which POV-Ray ignores, are below the resolution of single precision.
constexpr double k_stone_size = 1024;
constexpr int k_highest_level = 256;      // that POV-Ray accepts
constexpr int k_depth_by_tolerance = 64;  // used if the tolerance decides

void refuse_what_has_no_picture(const Scene& scene) {
    refuse_instruments(scene, "POV-Ray");
    if (scene.lights.environment)
        throw InputError(
            "an environment map (its texels would be looked up differently; use lobes, caps and "
            "hemispheres) cannot be carried to POV-Ray");
}

class PovrayWriter : SceneWriter {
public:
    explicit PovrayWriter(const Scene& scene)
        : SceneWriter(scene),
          setup_(make_optical_setup(scene)),
          scale_(std::exp2(std::ceil(std::log2(k_stone_size / size_)))) {}

    ExportedScene write() {
        header();
        camera();
        distant_lights();
        everything_by(*this);
        for (const std::string& note : result_.notes) line("// Not carried: {}", note);
        return std::move(result_);
    }

private:
    void header() {
        const Camera& camera = scene_.camera;
        const RenderSettings& settings = scene_.settings;
        const int depth = settings.depth > 0 ? settings.depth : k_depth_by_tolerance;
        const int level = std::min(depth + 1, k_highest_level);
        line("// POV-Ray 3.7: povray +ITHIS.pov +OPICTURE.png +W{} +H{} -A +FN16 File_Gamma=sRGB",
             camera.width, camera.height);
        line(
            "// -A: one ray through the middle of each pixel; a grid of 4 x 4: +AM1 +A0.0 -J +R4.");
        line("// PNG ends at 1: +FE (EXR, 11 bits) for brighter lights.");
        line("// Lengths: stone's unit x {}; y and z changed places.", scale_);
        line("#version 3.7;");
        line("global_settings {{ assumed_gamma 1 max_trace_level {} adc_bailout 0 }}", level);
        if (level <= depth)
            note(fmt::format("paths deeper than {} faces (POV-Ray's highest level)", level - 1));
        if (settings.depth == 0 || settings.tolerance > 0) {
            note(fmt::format("the tolerance: every path is followed through {} faces, none farther",
                             level - 1));
        }
        if (setup_.polarised)
            note("polarisation by the faces: the picture is that of effects = \"none\"");
    }

    void camera() {
        const Camera& camera = scene_.camera;
        const auto [forward, right, up] = axes_of(camera);
        // Width of the picture's plane; in POV-Ray's units for the orthographic camera.
        double width = 0;
        if (camera.orthographic_width) {
            width = *camera.orthographic_width * scale_;
        } else {
            width = 2 * std::tan(camera.fov / 2) * camera.width / camera.height;
        }
        const double height = width * camera.height / camera.width;
        // POV-Ray's `direction` points to the picture's middle, which may not be on the line of
        // sight.
        const auto [sight_x, sight_y] = line_of_sight_in(camera);
        const Vec3 to_middle = width * (0.5 - sight_x / camera.width) * right +
                               height * (sight_y / camera.height - 0.5) * up;
        const bool parallel = camera.orthographic_width.has_value();
        line("camera {{\n  {}\n  location {}\n  direction {}\n  right {}\n  up {}\n}}",
             parallel ? "orthographic" : "perspective",
             povray_vector(scale_ * camera.position + (parallel ? to_middle : Vec3(0))),
             povray_vector(parallel ? forward : forward + to_middle), povray_vector(width * right),
             povray_vector(height * up));
        if (setup_.on(Effects::aperture)) note("the lens: the picture is that of a pinhole");
    }

    // Distant lights add up: one function of the direction per channel, or one for all.
    struct Term {
        std::string shape;  // 0..1; empty: 1
        Rgb radiance{};
    };

    // A distant light's radiance by direction, relative to its maximum, as a function.
    static std::string cosine(const Vec3& d) {
        return fmt::format("({})*x + ({})*y + ({})*z", d.x, d.z, d.y);
    }
    static std::string shape(const CosinePowerLight& lobe) {
        return fmt::format("pow(max({}, 0), {})", cosine(lobe.direction), lobe.exponent);
    }
    static std::string shape(const HemisphereLight& half) {
        return fmt::format("select(-({}), 1, 0)", cosine(half.direction));
    }
    static std::string shape(const DiscLight& cap) {
        const std::string at = cosine(cap.direction);
        const std::string beyond =
            cap.from <= 0 ? "1" : fmt::format("select(({}) - ({}), 0, 1)", std::cos(cap.from), at);
        if (cap.to >= std::numbers::pi) return beyond;
        return fmt::format("select(({}) - ({}), {}, 0)", std::cos(cap.to), at, beyond);
    }

    void distant_lights() {
        const Lights& lights = scene_.lights;
        std::vector<Term> terms;
        for (const Light& light : lights.sources) {
            std::visit(
                [&](const auto& l) {
                    if constexpr (!std::decay_t<decltype(l)>::k_is_near) {
                        terms.push_back({shape(l), rgb_of_light(l.radiance)});
                    }
                },
                light);
        }
        if (terms.empty()) {
            line("background {{ rgb {} }}", lights.constant);
            return;
        }
        terms.push_back({"1", {lights.constant, lights.constant, lights.constant}});
        const bool grey = std::all_of(terms.begin(), terms.end(), [](const Term& term) {
            return term.radiance[0] == term.radiance[1] && term.radiance[1] == term.radiance[2];
        });
        line("sky_sphere {{ pigment {{");
        if (grey) {
            sky_channel(terms, 0, {1, 1, 1});
        } else {
            // The average of three tripled colours is their sum.
            line("  average pigment_map {{");
            for (int c = 0; c < 3; ++c) {
                Rgb unit{0, 0, 0};
                unit[c] = 3;
                line("  [1");
                sky_channel(terms, c, unit);
                line("  ]");
            }
            line("  }}");
        }
        line("}} }}");
    }

    void sky_channel(const std::vector<Term>& terms, int channel, const Rgb& unit) {
        double most = 0;
        std::string sum;
        for (const Term& term : terms) {
            if (term.radiance[channel] == 0) continue;
            most += std::abs(term.radiance[channel]);
            sum += fmt::format("{}({}) * {}", sum.empty() ? "" : "\n      + ",
                               term.radiance[channel], term.shape);
        }
        if (sum.empty()) {
            line("    rgb 0");
            return;
        }
        // A colour map ends at 1, where functions wrap to 0: use half of it.
        const double range = 2 * most;
        line("    function {{ ({}) / {} }}", sum, range);
        line("    color_map {{ [0 rgb 0] [1 {}] }}",
             povray_colour({range * unit[0], range * unit[1], range * unit[2]}));
    }

    void near(const SphereLight& sphere) {
        // Seen from inside a body, POV-Ray 3.7 renders no reflections inside a second one. A dome
        // around the camera is inverted, so that the camera counts as outside.
        const bool inside = glm::length(scene_.camera.position - sphere.center) < sphere.radius;
        line("sphere {{ {}, {} {}{} }}", povray_vector(scale_ * sphere.center),
             scale_ * sphere.radius, glowing(sphere.radiance), inside ? " inverse" : "");
    }

    void near(const PlaneLight& plane) {
        const double of_camera = height(plane, scene_.camera.position);
        double lowest = of_camera, highest = of_camera;
        for (const Vec3& corner : scene_.stone.solid.vertices) {
            lowest = std::min(lowest, height(plane, corner));
            highest = std::max(highest, height(plane, corner));
        }
        if (highest <= 0) {
            line("// A plane light with its back to everything: not there.");
            return;
        }
        if (of_camera <= 0) {
            throw InputError(
                "a plane light whose back is towards the camera cannot be carried to POV-Ray");
        }
        // Its back is invisible: transparent, which uses up a level in POV-Ray.
        std::string back;
        if (lowest < 0) {
            back = " interior_texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 } }";
            note("that the back of a plane light is not there: rays through it lose a level");
        }
        if (!plane.u || !plane.v) {
            line("plane {{ {}, {} {}{} }}", povray_vector(plane.normal),
                 scale_ * glm::dot(plane.point, plane.normal), glowing(plane.radiance), back);
            return;
        }
        // A mesh's front has counter-clockwise corners; they were clockwise before mirroring.
        const Vec3 &u = *plane.u, &v = *plane.v;
        const bool swap = glm::dot(glm::cross(u, v), plane.normal) > 0;
        const Vec3 corners[4] = {plane.point - u - v, plane.point + u - v, plane.point + u + v,
                                 plane.point - u + v};
        line("mesh2 {{ vertex_vectors {{ 4");
        for (const Vec3& corner : corners) line("    {}", povray_vector(scale_ * corner));
        line("  }} face_indices {{ 2 {} }}", swap ? "<0, 2, 1> <0, 3, 2>" : "<0, 1, 2> <0, 2, 3>");
        line("  {}{} }}", glowing(plane.radiance), back);
    }

    static double height(const PlaneLight& plane, const Vec3& point) {
        return glm::dot(point - plane.point, plane.normal);
    }
    std::string glowing(const LightColour& radiance) {
        return fmt::format("pigment {{ {} }} finish {{ ambient 0 diffuse 0 emission 1 }}",
                           povray_colour(rgb_of_light(radiance)));
    }
    void object(const SceneObject& object) {
        line("{}", povray_object(object, scale_, scene_.immersion, result_.notes));
    }
    void stone(const Stone& stone) {
        const TriangleMesh mesh = triangles_of(drawn_solid(stone));
        line("mesh2 {{ vertex_vectors {{ {}", mesh.vertices.size());
        for (const Vec3& vertex : mesh.vertices) line("    {}", povray_vector(scale_ * vertex));
        line("  }} face_indices {{ {}", mesh.triangles.size());
        for (const auto& t : mesh.triangles) line("    <{}, {}, {}>", t[0], t[1], t[2]);
        line("  }}");
        line("  pigment {{ rgbt 1 }}");
        line("  finish {{ ambient 0 diffuse 0 specular 0");
        line("    reflection {{ 0, 1 fresnel on }} conserve_energy }}");
        interior(stone);
        line("}}");
    }

    void interior(const Stone& stone) {
        const StoneOptics optics = optics_of(stone, scene_, result_.notes);
        if (optics.disperses)
            note(fmt::format("dispersion: the index at {} nm is written", optics.index_nm));
        const double ior = optics.index / scene_.immersion;
        if (optics.absorption == Rgb{}) {
            line("  interior {{ ior {} }}", ior);
            return;
        }
        // Use a medium, because POV-Ray's fade_distance does not attenuate partly reflected rays.
        Rgb absorption = optics.absorption;
        for (double& value : absorption) value /= scale_;
        line("  hollow interior {{ ior {} media {{ absorption {} }} }}", ior,
             povray_colour(absorption));
    }

    friend SceneWriter;
    OpticalSetup setup_;
    double scale_;
};

}  // namespace

ExportedScene povray_scene(const Scene& scene) {
    require_renderable(scene);
    refuse_what_has_no_picture(scene);
    return PovrayWriter(scene).write();
}

}  // namespace culet
