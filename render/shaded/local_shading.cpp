#include "render/shaded/local_shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

Rgb local_radiance(const PlainShading& shading, const PlainLights& lights,
                   const PlainSurface& surface, const Vec3& at, Vec3 normal,
                   const Vec3& toward_eye) {
    if (surface.glows) return surface.colour;
    if (glm::dot(normal, toward_eye) < 0) normal = -normal;
    Rgb sum = shading.ambient * (lights.ambient() * surface.colour);
    for (const PlainLight& light : lights.lights()) {
        const Incoming incoming = lights.incoming(light, at);
        const double cosine = glm::dot(normal, incoming.direction);
        if (!(cosine > 0)) continue;
        const Vec3 reflected = 2 * cosine * normal - incoming.direction;
        const double highlight =
            std::pow(std::max(0.0, glm::dot(reflected, toward_eye)), shading.exponent);
        sum += incoming.strength * ((shading.diffuse * cosine) * surface.colour +
                                    (shading.specular * highlight) * surface.highlight);
    }
    return sum;
}

LocalShader::LocalShader(const Scene& scene, LocalShading shading)
    : kind_(shading),
      shading_(scene.shading),
      eye_(scene.camera.position),
      bodies_(scene, shading != LocalShading::phong),
      lights_(scene, middle_of(scene)) {
    const Camera& camera = scene.camera;
    if (camera.orthographic_width || camera.cone)
        toward_eye_ = glm::normalize(camera.position - camera.look_at);
    for (int i = 0; i < bodies_.size(); ++i) {
        facet_colours_.emplace_back();
        corner_colours_.emplace_back();
        const FacetedBody* body = bodies_.body(i);
        if (body == nullptr) continue;
        if (kind_ == LocalShading::flat) {
            for (const auto& facet : body->facets)
                facet_colours_.back().push_back(colour_at(i, facet.middle, facet.normal));
        } else if (kind_ == LocalShading::gouraud) {
            for (std::size_t t = 0; t < body->mesh->triangles.size(); ++t) {
                std::array<Rgb, 3> colours;
                for (std::size_t k = 0; k < 3; ++k)
                    colours[k] = colour_at(i, body->mesh->vertices[body->mesh->triangles[t][k]],
                                           body->corner_normals[t][k]);
                corner_colours_.back().push_back(colours);
            }
        }
    }
}

Vec3 LocalShader::toward_eye(const Vec3& at) const {
    return toward_eye_ ? *toward_eye_ : glm::normalize(eye_ - at);
}

Rgb LocalShader::colour_at(int body, const Vec3& at, const Vec3& normal) const {
    return local_radiance(shading_, lights_, bodies_.surface(body), at, normal, toward_eye(at));
}

Rgb LocalShader::colour_of(const WorldHit& hit, const Vec3& at) const {
    const FacetedBody* body = bodies_.body(hit.object);
    if (body == nullptr) {
        const bool whole = kind_ == LocalShading::flat;
        return colour_at(hit.object, whole ? bodies_.middle(hit.object) : at, hit.normal);
    }
    const auto object = static_cast<std::size_t>(hit.object);
    const auto triangle = static_cast<std::size_t>(hit.part);
    if (kind_ == LocalShading::flat)
        return facet_colours_[object][static_cast<std::size_t>(body->facet_of[triangle])];
    const std::array<double, 3> weights = body->weights(hit.part, at);
    if (kind_ == LocalShading::gouraud) {
        Rgb colour{0, 0, 0};
        for (std::size_t k = 0; k < 3; ++k)
            colour += weights[k] * corner_colours_[object][triangle][k];
        return colour;
    }
    Vec3 normal(0);
    for (std::size_t k = 0; k < 3; ++k) normal += weights[k] * body->corner_normals[triangle][k];
    const double length = glm::length(normal);
    return colour_at(hit.object, at, length > 0 ? normal / length : hit.normal);
}

LocalShader::Seen LocalShader::shade(const EyeRay& ray) const {
    const WorldHit hit = bodies_.world().nearest(ray.origin, ray.direction, {});
    if (!hit.met() || lights_.nearest_distance(ray.origin, ray.direction) < hit.distance)
        return {lights_.seen(ray.origin, ray.direction), false};
    return {colour_of(hit, bodies_.world().place(hit, ray.origin, ray.direction)), true};
}

}  // namespace culet
