#include "render/export/scene_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>

#include "stone/solid/facet_triangles.h"
#include "stone/solid/perpendicular.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Other renderers hold corners in single precision; nearer ones coincide.
constexpr double k_single_precision = 1e-7;
// Default wavelengths: enough for colours, and fast.
const std::vector<double> k_colour_nodes{450, 500, 550, 610, 650};

}  // namespace

void add_note(std::vector<std::string>& notes, const std::string& note) {
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

void refuse_instruments(const Scene& scene, const std::string& program) {
    const Camera& camera = scene.camera;
    const auto refuse = [&](const char* what) {
        throw InputError(fmt::format("{} cannot be carried to {}", what, program));
    };
    if (camera.cone) refuse("a conoscope's camera");
    if (camera.optics.analyzer || camera.optics.retarder || camera.optics.two_windows)
        refuse("an analyser, retarder or dichroscope before the eye");
    if (polarised(scene.lights)) refuse("polarised light");
}

Solid drawn_solid(const Stone& stone) {
    const double tolerance = k_single_precision * diameter(stone.solid);
    if (!stone.convex || planarity(stone.solid) <= tolerance) return stone.solid;
    std::vector<NamedPlane> planes;
    for (const Facet& facet : stone.solid.facets) planes.push_back({facet.name, facet.plane});
    return contract_near_meets(intersect_half_spaces(planes).solid, tolerance).solid;
}

TriangleMesh triangles_of(const Solid& solid) {
    TriangleMesh mesh;
    mesh.vertices = solid.vertices;
    for (const Facet& facet : solid.facets) {
        for (const auto& triangle : facet_triangles(solid, facet))
            mesh.triangles.push_back(triangle);
    }
    return mesh;
}

TriangleMesh triangles_of(const BoxShape& box) {
    TriangleMesh mesh;
    // Bit k of a corner's number is set if it is farther out along axis k.
    for (int k = 0; k < 8; ++k) {
        Vec3 corner = box.center;
        for (int axis = 0; axis < 3; ++axis)
            corner += ((k >> axis) & 1 ? 1.0 : -1.0) * box.half[axis] * box.axes[axis];
        mesh.vertices.push_back(corner);
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    // Left-handed axes would turn the mesh inside out.
    if (glm::dot(glm::cross(box.axes[0], box.axes[1]), box.axes[2]) < 0) {
        for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    }
    return mesh;
}

double size_of(const Scene& scene) {
    if (scene.has_stone()) return diameter(scene.stone.solid);
    return glm::length(scene.camera.look_at - scene.camera.position);
}

CameraAxes axes_of(const Camera& camera) {
    const Vec3 forward = glm::normalize(camera.look_at - camera.position);
    const Vec3 right = glm::normalize(glm::cross(forward, camera.up));
    return {forward, right, glm::cross(right, forward)};
}

InPlane in_plane(const Vec3& normal) {
    const Vec3 u = perpendicular_to(normal);
    return {u, glm::cross(normal, u)};
}

InPlane extent_of(const PlaneLight& plane, double far) {
    if (!plane.u || !plane.v) {
        const auto [u, v] = in_plane(plane.normal);
        return {far * u, far * v};
    }
    const bool left = glm::dot(glm::cross(*plane.u, *plane.v), plane.normal) < 0;
    return left ? InPlane{*plane.v, *plane.u} : InPlane{*plane.u, *plane.v};
}

LightRgb::LightRgb(const Scene& scene)
    : one_wavelength_(scene.settings.wavelengths_nm.size() == 1),
      colours_(one_wavelength_ ? scene.settings.wavelengths_nm : k_colour_nodes) {}

Rgb LightRgb::of(const LightColour& light, std::vector<std::string>& notes) const {
    if (const double* number = std::get_if<double>(&light.value))
        return {*number, *number, *number};
    if (const Rgb* rgb = std::get_if<Rgb>(&light.value))
        return one_wavelength_ ? colours_.rgb_of(colours_.spectrum_of(*rgb).data()) : *rgb;
    const std::string& name = std::get<std::string>(light.value);
    if (name != "D65" && !one_wavelength_)
        add_note(notes, fmt::format("the spectrum of illuminant {}: its colour only", name));
    return colours_.rgb_of(colours_.illuminant_relative(name.c_str()).data());
}

DistantLights::DistantLights(const Lights& lights, const LightRgb& rgb,
                             std::vector<std::string>& notes)
    : lights_(lights) {
    for (const Light& light : lights.sources) {
        if (is_near(light)) continue;
        const auto* cap = std::get_if<DiscLight>(&light);
        parts_.push_back({&light, rgb.of(colour_of(light), notes),
                          cap != nullptr ? cosines_of(*cap) : DiscCosines()});
    }
}

bool DistantLights::is_even() const {
    return !lights_.environment && parts_.empty();
}

bool DistantLights::has_edges() const {
    return std::any_of(parts_.begin(), parts_.end(),
                       [](const Part& part) { return has_edge(*part.light); });
}

Rgb DistantLights::from(const Vec3& direction) const {
    Rgb sum{lights_.constant, lights_.constant, lights_.constant};
    if (lights_.environment) sum = lights_.environment->at(direction);
    for (const Part& part : parts_) {
        const auto share = [&](const auto& light) {
            using Kind = std::decay_t<decltype(light)>;
            if constexpr (std::is_same_v<Kind, DiscLight>)
                return share_of(light, part.cosines, direction);
            else if constexpr (!Kind::k_is_near)
                return share_of(light, direction);
            else
                return 0.0;
        };
        const double of_light = std::visit(share, *part.light);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += of_light * part.colour[c];
    }
    return sum;
}

std::string plain_stem(const std::string& stem) {
    std::string plain = stem;
    for (char& c : plain) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '.') c = '_';
    }
    return plain;
}

}  // namespace culet
