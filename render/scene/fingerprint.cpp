#include "render/scene/fingerprint.h"

#include <fmt/format.h>

namespace culet {

namespace {

void add_colour(Fingerprint& print, const LightColour& colour) {
    std::visit(
        [&](const auto& value) {
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, Rgb>) {
                for (const double c : value) print.add(c);
            } else {
                print.add(value);
            }
        },
        colour.value);
    print.add(colour.polarisation ? 1 : 0);
    if (colour.polarisation) {
        print.add(colour.polarisation->vibration);
        print.add(colour.polarisation->degree);
        print.add(colour.polarisation->normal.value_or(Vec3(0)));
    }
}

struct AddPart {
    Fingerprint& print;
    void point(const Vec3& p) const { print.add(p); }
    void direction(const Vec3& d) const { print.add(d); }
    void extent(const std::optional<Vec3>& e) const { print.add(e.value_or(Vec3(0))); }
    void number(double v) const { print.add(v); }
};

void add_photometry(Fingerprint& print, const Photometry* photometry) {
    if (photometry == nullptr) return;
    print.add(static_cast<int>(photometry->type));
    print.add(photometry->vertical);
    print.add(photometry->horizontal);
    print.add(photometry->candela);
}

void add_lights(Fingerprint& print, const Lights& lights) {
    print.add(lights.constant);
    if (lights.environment) {
        print.add(lights.environment->width);
        print.add(lights.environment->rgb);
    }
    if (lights.polarisation) add_colour(print, {0.0, lights.polarisation});
    for (const Light& light : lights.sources) {
        std::visit(
            [&](const auto& l) {
                print.add(l.k_name);
                l.each_part(l, AddPart{print});
                add_colour(print, l.radiance);
                if constexpr (requires { l.photometry; }) add_photometry(print, l.photometry.get());
            },
            light);
    }
}

void add_material(Fingerprint& print, const Material& material) {
    print.add(static_cast<int>(material.optic));
    for (int r = 0; r < ray_count(material.optic); ++r) {
        const auto k = static_cast<std::size_t>(r);
        for (double nm = 380; nm <= 780; nm += 10) print.add(material.index[k].at(nm));
    }
    for (const Spectrum& spectrum : material.absorption_per_mm) {
        print.add(spectrum.wavelengths_nm());
        print.add(spectrum.values());
    }
}

struct AddShape {
    Fingerprint& print;
    void operator()(const SphereShape& s) const {
        print.add(s.center);
        print.add(s.radius);
    }
    void operator()(const PlaneShape& s) const {
        print.add(s.point);
        print.add(s.normal);
    }
    void operator()(const DiscShape& s) const {
        print.add(s.center);
        print.add(s.normal);
        print.add(s.radius);
    }
    void operator()(const BoxShape& s) const {
        print.add(s.center);
        for (const Vec3& axis : s.axes) print.add(axis);
        print.add(s.half);
    }
    void operator()(const MeshShape& s) const {
        for (const Vec3& vertex : s.mesh->vertices) print.add(vertex);
        for (const auto& triangle : s.mesh->triangles) {
            for (const int corner : triangle) print.add(corner);
        }
        for (const auto& corners : s.mesh->corner_normals) {
            for (const Vec3& normal : corners) print.add(normal);
        }
    }
};

struct AddSurface {
    Fingerprint& print;
    void colour(const SurfaceColour& c) const {
        std::visit([this](const auto& value) { add_colour(print, {value, {}}); }, c.value);
    }
    void operator()(const DiffuseMaterial& m) const { colour(m.albedo); }
    void operator()(const MetalMaterial& m) const {
        colour(m.n);
        colour(m.k);
        if (m.f0) colour(*m.f0);
        print.add(m.roughness);
    }
    void operator()(const MirrorMaterial& m) const { colour(m.albedo); }
    void operator()(const DielectricMaterial& m) const {
        print.add(m.index);
        colour(m.absorption);
    }
    void operator()(const EmitterMaterial& m) const { add_colour(print, m.radiance); }
};

void add_object(Fingerprint& print, const SceneObject& object) {
    print.add(static_cast<int>(object.shape.index()));
    std::visit(AddShape{print}, object.shape);
    print.add(static_cast<int>(object.material.index()));
    std::visit(AddSurface{print}, object.material);
}

void add_camera(Fingerprint& print, const Camera& camera) {
    print.add(camera.position);
    print.add(camera.look_at);
    print.add(camera.up);
    print.add(camera.fov);
    print.add(camera.orthographic_width.value_or(-1));
    print.add(camera.width);
    print.add(camera.height);
    for (const double c : line_of_sight_in(camera)) print.add(c);
    print.add(camera.aperture_radius);
    print.add(camera.focus_distance);
    print.add(camera.cone.value_or(-1));
    print.add(camera.optics.analyzer.value_or(-100));
    print.add(camera.optics.two_windows ? 1 : 0);
    if (camera.optics.retarder) {
        print.add(camera.optics.retarder->retardation_nm);
        print.add(camera.optics.retarder->slow_axis);
    }
}

void add_shading(Fingerprint& print, const PlainShading& shading) {
    print.add(shading.ambient);
    print.add(shading.diffuse);
    print.add(shading.specular);
    print.add(shading.exponent);
    for (const double part : shading.attenuation) print.add(part);
}

void add_settings(Fingerprint& print, const RenderSettings& settings) {
    print.add(settings.engine);
    print.add(static_cast<int>(settings.refraction));
    print.add(settings.crystal_beams ? static_cast<int>(*settings.crystal_beams) : -1);
    print.add(settings.depth);
    print.add(settings.tolerance);
    print.add(settings.cut_weight.value_or(-1));
    print.add(settings.split_weight.value_or(-1));
    if (settings.clamp_indirect) print.add(*settings.clamp_indirect);
    print.add(settings.wavelength_turns.value_or(1));
    print.add(static_cast<double>(settings.most_beams));
    print.add(static_cast<int>(settings.check));
    print.add(settings.checked_pixels);
    print.add(settings.checked_samples);
    print.add(settings.effects_auto ? 1 : 0);
    for (const bool on : settings.effects) print.add(on ? 1 : 0);
    print.add(settings.coherence ? (*settings.coherence ? 1 : 0) : -1);
    print.add(settings.bandwidth_nm.value_or(-1));
    print.add(settings.wavelengths_nm);
    print.add(settings.samples);
    print.add(static_cast<int>(settings.filter));
    print.add(settings.filter_radius);
    print.add(static_cast<double>(settings.seed));
    if (settings.reflection_factor || settings.transmission_factor) {
        print.add(settings.reflection_factor.value_or(-1));
        print.add(settings.transmission_factor.value_or(-1));
    }
}

}  // namespace

void Fingerprint::add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) {
        a_ = (a_ ^ bytes[i]) * 0x100000001b3u;
        b_ = (b_ ^ bytes[i] ^ 0x5a) * 0x100000001b3u;
    }
}

void Fingerprint::add(std::string_view text) {
    add(static_cast<double>(text.size()));
    add_bytes(text.data(), text.size());
}

void Fingerprint::add(double value) {
    const double positive_zero = value == 0 ? 0 : value;
    add_bytes(&positive_zero, sizeof positive_zero);
}

void Fingerprint::add(const Vec3& v) {
    add(v.x);
    add(v.y);
    add(v.z);
}

void Fingerprint::add(const std::vector<float>& values) {
    add(static_cast<double>(values.size()));
    add_bytes(values.data(), values.size() * sizeof(float));
}

void Fingerprint::add(const std::vector<double>& values) {
    add(static_cast<double>(values.size()));
    add_bytes(values.data(), values.size() * sizeof(double));
}

void Fingerprint::add(const Solid& solid) {
    for (const Facet& facet : solid.facets) {
        add(facet.name);
        add(facet.plane.normal);
        add(facet.plane.offset);
    }
    for (const Vec3& vertex : solid.vertices) add(vertex);
}

void Fingerprint::add(const Stone& stone) {
    add(stone.solid);
    add(stone.convex ? 1 : 0);
    add(static_cast<int>(stone.unit));
    add(stone.up);
    for (const Vec3& axis : stone.crystal.axes) add(axis);
    add_material(*this, stone.material);
}

void Fingerprint::add_stone_and_light(const Scene& scene) {
    add(scene.stone);
    for (const Stone& stone : scene.more_stones) add(stone);
    for (const SceneObject& object : scene.objects) add_object(*this, object);
    add_lights(*this, scene.lights);
    add(scene.immersion);
}

void Fingerprint::add(const Scene& scene) {
    add_stone_and_light(scene);
    add_camera(*this, scene.camera);
    add_settings(*this, scene.settings);
    add_shading(*this, scene.shading);
}

std::string Fingerprint::hex() const {
    return fmt::format("{:016x}{:016x}", a_, b_);
}

}  // namespace culet
