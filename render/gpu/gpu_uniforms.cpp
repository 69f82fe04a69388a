// Uniforms that change interactively: view, lights, the eye's optics.

#include <glm/geometric.hpp>

#include "render/beams/beam_lights.h"
#include "render/beams/screen_view.h"
#include "render/gpu/gpu_program.h"
#include "render/optics/eye_optics.h"

namespace culet {

namespace {

void append(std::vector<float>& values, const Vec3& v) {
    for (int k = 0; k < 3; ++k) values.push_back(static_cast<float>(v[k]));
}

GpuUniform vector(const char* name, const Vec3& v) {
    GpuUniform uniform{name, 3, false, {}};
    append(uniform.values, v);
    return uniform;
}

void add_if_any(std::vector<GpuUniform>& uniforms, GpuUniform uniform) {
    if (!uniform.values.empty()) uniforms.push_back(std::move(uniform));
}

// In the kernel's order of the lights.
template <class Visit>
void each_polarisation(const ShadedLights& lights, Visit&& visit) {
    for (const auto& light : lights.spheres) visit(light.polarised);
    for (const auto& light : lights.planes) visit(light.polarised);
    for (const auto& light : lights.lobes) visit(light.polarised);
    for (const auto& light : lights.caps) visit(light.polarised);
    visit(lights.surroundings);
}

}  // namespace

std::vector<GpuUniform> gpu_view(const Camera& camera, const SamplePoint& sample,
                                 const Vec3& middle) {
    const ScreenView view = screen_view(camera, sample.pupil_x, sample.pupil_y);
    // Ray origins are moved next to the stone, into the plane across the line of sight through its
    // middle, so that single precision loses no digits to the distance from the eye.
    const double way = glm::dot(middle - view.o, view.forward) / glm::dot(view.v, view.forward);
    // Fragments have half-integer coordinates with y upwards: a sample lies at x - 0.5 + sample.x
    // to the right and height - y - 0.5 + sample.y down.
    const ScreenPoint corner{sample.x - 0.5, camera.height - 0.5 + sample.y};
    const Vec3 towards = view.towards(corner), at = view.origin(corner) + way * towards - middle;
    return {vector("u_at", at),
            vector("u_at_x", view.ox + way * view.vx),
            vector("u_at_y", -(view.oy + way * view.vy)),
            vector("u_towards", towards),
            vector("u_towards_x", view.vx),
            vector("u_towards_y", -view.vy),
            {"u_eye", 1, false, {static_cast<float>(way)}},
            vector("u_forward", view.forward),
            vector("u_right", view.right)};
}

std::vector<GpuUniform> gpu_lights(const Lights& lights, const Vec3& middle) {
    const WavelengthSet any({550});
    const ShadedLights shaded(lights, any, 0, 1, middle, nullptr);
    std::vector<GpuUniform> uniforms{
        {"u_constant", 1, false, {static_cast<float>(lights.constant)}}};
    GpuUniform spheres{"u_spheres", 4, false, {}}, lamps{"u_lamps", 4, false, {}},
        planes{"u_planes", 4, false, {}}, lobes{"u_lobes", 4, false, {}},
        whole{"u_lobe_whole", 1, true, {}}, caps{"u_caps", 4, false, {}},
        vibration{"u_vibration", 4, false, {}};
    const auto append_all = [](GpuUniform& to, std::initializer_list<float> v) {
        to.values.insert(to.values.end(), v);
    };
    for (const auto& s : shaded.spheres) {
        if (s.lamp) {
            append(lamps.values, s.lamp->axis);
            lamps.values.push_back(static_cast<float>(spheres.values.size() / 4));
            append(lamps.values, s.lamp->zero);
            lamps.values.push_back(0);
        }
        append_all(spheres, {s.x, s.y, s.z, s.radius});
    }
    for (const auto& p : shaded.planes) {
        append_all(planes, {p.x, p.y, p.z, p.offset, p.s[0], p.s[1], p.s[2], p.s[3], p.t[0], p.t[1],
                            p.t[2], p.t[3]});
    }
    for (const auto& l : shaded.lobes) {
        append_all(lobes, {l.x, l.y, l.z, l.exponent});
        whole.values.push_back(static_cast<float>(l.whole));
    }
    for (const auto& c : shaded.caps) {
        append_all(caps, {c.x, c.y, c.z, c.outer.cosine, c.outer.sine, c.inner.cosine, c.inner.sine,
                          0.0f});
    }
    if (polarised(lights)) {
        each_polarisation(shaded, [&](const ShadedLights::Polarised& p) {
            append_all(vibration, {p.along[0], p.along[1], p.along[2], p.degree, p.normal[0],
                                   p.normal[1], p.normal[2], p.sheet ? 1.0f : 0.0f});
        });
    }
    for (GpuUniform* uniform : {&spheres, &lamps, &planes, &lobes, &whole, &caps, &vibration})
        add_if_any(uniforms, std::move(*uniform));
    return uniforms;
}

std::vector<GpuUniform> gpu_eye(const EyeOptics& optics, const OpticalSetup& setup,
                                const GpuPass& pass) {
    if (!setup.stokes) return {};
    GpuUniform rows{"u_response", 4, false, {}};
    for (int i = pass.first; i < pass.first + pass.count; ++i) {
        for (const double v : response(optics, setup.wavelengths_nm[static_cast<std::size_t>(i)]))
            rows.values.push_back(static_cast<float>(v));
    }
    return {rows};
}

}  // namespace culet
