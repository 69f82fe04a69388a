#pragma once
// One light of each kind, and scenes of each kind of optics.

#include <functional>
#include <string>
#include <vector>

#include "tests/render/beams/beam_scenes.h"

namespace culet {

struct NamedChange {
    std::string name;
    std::function<void(Scene&)> make;
};

inline std::shared_ptr<const EnvironmentMap> smooth_environment(int width = 64) {
    auto map = std::make_shared<EnvironmentMap>();
    map->width = width;
    map->height = width / 2;
    for (int y = 0; y < map->height; ++y) {
        for (int x = 0; x < map->width; ++x) {
            const double a = 2 * std::numbers::pi * (x + 0.5) / width,
                         p = std::numbers::pi * (y + 0.5) / map->height;
            const double s = std::sin(p);
            map->rgb.push_back(static_cast<float>(1 + 0.6 * s * std::cos(a)));
            map->rgb.push_back(static_cast<float>(1 + 0.5 * std::cos(p)));
            map->rgb.push_back(static_cast<float>(1 + 0.4 * s * std::sin(a)));
        }
    }
    return map;
}

inline std::vector<NamedChange> edgeless_lights() {
    const auto dark = [](Scene& s) { s.lights = {}; };
    return {
        {"constant", [](Scene& s) { s.lights.constant = 1; }},
        {"lobe, whole exponents",
         [dark](Scene& s) {
             dark(s);
             s.lights.sources.push_back(
                 CosinePowerLight{glm::normalize(Vec3{0.2, 0.3, 1}), 1, {2.0, {}}});
             s.lights.sources.push_back(
                 CosinePowerLight{glm::normalize(Vec3{-0.5, 0.1, 0.6}), 7, {3.0, {}}});
             s.lights.sources.push_back(
                 CosinePowerLight{glm::normalize(Vec3{0, -0.5, 0.3}), 64, {5.0, {}}});
         }},
        {"lobe, fractional exponents",
         [dark](Scene& s) {
             dark(s);
             s.lights.sources.push_back(
                 CosinePowerLight{glm::normalize(Vec3{0.2, 0.3, 1}), 0.5, {2.0, {}}});
             s.lights.sources.push_back(
                 CosinePowerLight{glm::normalize(Vec3{-0.5, 0.1, 0.6}), 7.3, {3.0, {}}});
             s.lights.sources.push_back(
                 CosinePowerLight{glm::normalize(Vec3{0, -0.5, 0.3}), 120, {5.0, {}}});
         }},
    };
}
/// Different in every direction, by steps of 10 and 30 degrees.
inline std::shared_ptr<const Photometry> wavy_lamp() {
    Photometry lamp;
    lamp.greatest = 2;
    for (int h = 0; h <= 360; h += 30) {
        lamp.horizontal.push_back(h);
        for (int v = 0; v <= 180; v += 10) {
            if (h == 0) lamp.vertical.push_back(v);
            lamp.candela.push_back(1 + std::sin(radians(v)) * std::cos(radians(h) + 5));
        }
    }
    return std::make_shared<const Photometry>(std::move(lamp));
}
inline std::vector<NamedChange> edged_lights() {
    const auto dark = [](Scene& s) { s.lights = {}; };
    return {
        {"hemisphere",
         [dark](Scene& s) {
             dark(s);
             s.lights.sources.push_back(
                 HemisphereLight{glm::normalize(Vec3{0.1, 0.2, 1}), {1.5, {}}});
         }},
        {"cap with a hole",
         [dark](Scene& s) {
             dark(s);
             s.lights.sources.push_back(
                 DiscLight{glm::normalize(Vec3{0.1, 0.2, 1}), 0.3, 0.9, {2.0, {}}});
             s.lights.sources.push_back(
                 DiscLight{glm::normalize(Vec3{-1, 0.2, 0.4}), 0.0, 0.35, {4.0, {}}});
         }},
        {"spheres, one before another",
         [dark](Scene& s) {
             dark(s);
             s.lights.constant = 0.2;
             s.lights.sources.push_back(SphereLight{{4, 2, 6}, 2, {3.0, {}}});
             s.lights.sources.push_back(SphereLight{{-3, 1, 3}, 1, {5.0, {}}});
             s.lights.sources.push_back(SphereLight{{0.5, 0.4, -4}, 1.5, {2.0, {}}});
             s.lights.sources.push_back(SphereLight{{3, 1.6, 4}, 0.4, {0.5, {}}});
         }},
        {"dome around everything",
         [dark](Scene& s) {
             dark(s);
             s.lights.sources.push_back(SphereLight{{1, 0, 2}, 60, {1.2, {}}});
             s.lights.sources.push_back(SphereLight{{4, 2, 6}, 2, {3.0, {}}});
         }},
        {"planes, bounded and not",
         [dark](Scene& s) {
             dark(s);
             s.lights.constant = 0.1;
             s.lights.sources.push_back(
                 PlaneLight{{0, 0, 9}, {0, 0, -1}, Vec3{3, 0, 0}, Vec3{0.4, 2, 0}, {3.0, {}}});
             s.lights.sources.push_back(
                 PlaneLight{{-6, 0, 0}, {1, 0, 0}, Vec3{0, 2, 0}, Vec3{0, 0, 2}, {2.0, {}}});
             s.lights.sources.push_back(PlaneLight{{0, 0, -8}, {0, 0, 1}, {}, {}, {0.6, {}}});
         }},
        {"lamps, beside a sphere",
         [dark](Scene& s) {
             dark(s);
             s.lights.constant = 0.1;
             s.lights.sources.push_back(SphereLight{{-3, 1, 3}, 1, {0.5, {}}});
             for (const double x : {-5.0, 6.0}) {
                 LampLight lamp{{x, -3, 6}, 2.5, {0, 0, -1}, {1, 0, 0}, wavy_lamp(), {3.0, {}}};
                 lamp.axis = glm::normalize(Vec3{-0.8 * x, 2, -6});
                 lamp.zero = glm::normalize(glm::cross(lamp.axis, Vec3{0.3, 1, 0}));
                 s.lights.sources.push_back(lamp);
             }
         }},
        {"everything at once",
         [dark](Scene& s) {
             dark(s);
             s.lights.constant = 0.1;
             s.lights.sources.push_back(
                 CosinePowerLight{glm::normalize(Vec3{0.2, 0.3, 1}), 3.5, {1.0, {}}});
             s.lights.sources.push_back(
                 HemisphereLight{glm::normalize(Vec3{0.1, 0.2, 1}), {0.3, {}}});
             s.lights.sources.push_back(
                 DiscLight{glm::normalize(Vec3{-1, 0.2, 0.4}), 0.1, 0.35, {4.0, {}}});
             s.lights.sources.push_back(SphereLight{{4, 2, 6}, 2, {3.0, {}}});
             s.lights.sources.push_back(
                 PlaneLight{{0, 0, 9}, {0, 0, -1}, Vec3{3, 0, 0}, Vec3{0.4, 2, 0}, {3.0, {}}});
         }},
    };
}

/// Changes to a scene other than its lights.
inline std::vector<NamedChange> optics() {
    const auto coloured = [](Scene& s) {
        s.stone.material.absorption_per_mm[0] = Spectrum({400, 550, 700}, {0.9, 0.2, 0.05});
    };
    const auto dispersive = [](Scene& s) {
        s.stone.material.index[0].form = RefractiveIndex::Form::cauchy;
        s.stone.material.index[0].cauchy = {2.38, 0.012, 0};
    };
    return {
        {"as it is", [](Scene&) {}},
        {"not polarised",
         [](Scene& s) {
             s.settings.effects_auto = false;
             s.settings.effects = {true, false, false, true, false, true, false};
         }},
        {"coloured, 4 wavelengths",
         [coloured](Scene& s) {
             coloured(s);
             s.settings.wavelengths_nm = {450, 520, 590, 650};
         }},
        {"coloured, one wavelength", coloured},
        {"dispersive, 3 wavelengths",
         [dispersive](Scene& s) {
             dispersive(s);
             s.settings.wavelengths_nm = {450, 550, 640};
         }},
        {"dispersive and coloured",
         [coloured, dispersive](Scene& s) {
             coloured(s);
             dispersive(s);
             s.settings.wavelengths_nm = {450, 550, 640};
         }},
        {"orthographic", [](Scene& s) { s.camera.orthographic_width = 2.2; }},
        {"barely denser than what surrounds it",
         [](Scene& s) {
             s.immersion = 1.5;
             s.stone.material.index[0].n = 1.501;
         }},
        {"in the stone's own unit", [](Scene& s) { s.stone.unit = LengthUnit::cm; }},
    };
}

}  // namespace culet
