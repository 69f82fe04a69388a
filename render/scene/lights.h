#pragma once
// The light types. Lengths in the stone's unit, angles in radians.
//
// A type has a name, a radiance (`distance_to` or `share_of` below) and parts (`each_part`, by
// which lights are turned and compared). Everything else that depends on the type (scene files,
// beams, exports, rims) uses std::visit, so that a forgotten type does not compile. CONTRIBUTING.md
// lists these places.

#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <variant>
#include <vector>

#include "render/colour/colour.h"
#include "render/scene/photometry.h"
#include "stone/solid/solid.h"

namespace culet {

/// Light that vibrates along one direction, as behind a polariser.
struct LinearPolarisation {
    Vec3 vibration{1, 0, 0};  ///< unit
    /// Normal of the polariser's sheet. Oblique rays vibrate along `vibration` turned by the least
    /// rotation from the normal to the ray. None: along its projection.
    std::optional<Vec3> normal;
    double degree = 1;  ///< 0..1 of the radiance; the rest is unpolarised
    /// Unit vibration of a ray that travels along or against the unit `direction`.
    Vec3 of_ray(const Vec3& direction) const;
};

/// Radiance of a light (behind its polariser): a number (D65 white), a colour, or an illuminant by
/// name ("D65", "A").
struct LightColour {
    std::variant<double, Rgb, std::string> value = 1.0;
    std::optional<LinearPolarisation> polarisation = {};
};

/// Radiance from all directions as a lat-long map; environment_layout.h has the frame.
struct EnvironmentMap {
    int width = 0, height = 0;
    std::vector<float> rgb;
    /// Bilinear between texel centres; wraps in azimuth, clamps at the poles.
    Rgb at(const Vec3& direction) const;
};

/// Shines outwards, and inwards on what it contains (a dome).
struct SphereLight {
    static constexpr const char *k_name = "sphere", *k_names = "spheres";
    static constexpr bool k_is_near = true, k_has_edge = true;
    Vec3 center;
    double radius = 1;
    LightColour radiance;

    template <class Self, class Visit>
    static void each_part(Self& light, Visit&& visit) {
        visit.point(light.center);
        visit.number(light.radius);
    }
};
/// radiance * cos^exponent of the angle to `direction`.
struct CosinePowerLight {
    static constexpr const char *k_name = "lobe", *k_names = "lobes";
    static constexpr bool k_is_near = false, k_has_edge = false;
    Vec3 direction;
    double exponent = 1;
    LightColour radiance;

    template <class Self, class Visit>
    static void each_part(Self& light, Visit&& visit) {
        visit.direction(light.direction);
        visit.number(light.exponent);
    }
};
struct HemisphereLight {
    static constexpr const char *k_name = "hemisphere", *k_names = "hemispheres";
    static constexpr bool k_is_near = false, k_has_edge = true;
    Vec3 direction;
    LightColour radiance;

    template <class Self, class Visit>
    static void each_part(Self& light, Visit&& visit) {
        visit.direction(light.direction);
    }
};
/// Directions whose angle to `direction` is in [from, to).
struct DiscLight {
    static constexpr const char *k_name = "cap", *k_names = "caps";
    static constexpr bool k_is_near = false, k_has_edge = true;
    Vec3 direction;
    double from = 0, to = 0.0047;
    LightColour radiance;

    template <class Self, class Visit>
    static void each_part(Self& light, Visit&& visit) {
        visit.direction(light.direction);
        visit.number(light.from);
        visit.number(light.to);
    }
};
/// Emits on the side of its normal; invisible from behind. Infinite, or a parallelogram with
/// half-extents `u`, `v` in the plane.
struct PlaneLight {
    static constexpr const char *k_name = "plane", *k_names = "planes";
    static constexpr bool k_is_near = true, k_has_edge = true;
    Vec3 point, normal;
    std::optional<Vec3> u, v;
    LightColour radiance;

    template <class Self, class Visit>
    static void each_part(Self& light, Visit&& visit) {
        visit.point(light.point);
        visit.direction(light.normal);
        visit.extent(light.u);
        visit.extent(light.v);
    }
};

/// A ball whose radiance depends on the direction alone, so that its intensity is exactly that of
/// its photometry in every direction.
struct LampLight {
    static constexpr const char *k_name = "lamp", *k_names = "lamps";
    static constexpr bool k_is_near = true, k_has_edge = true;
    Vec3 center;
    double radius = 1;
    Vec3 axis{0, 0, -1}, zero{1, 0, 0};  ///< z and x of its photometry: unit, perpendicular
    std::shared_ptr<const Photometry> photometry;  ///< none: the same in all directions
    LightColour radiance;                          ///< in the direction of the greatest intensity

    template <class Self, class Visit>
    static void each_part(Self& light, Visit&& visit) {
        visit.point(light.center);
        visit.number(light.radius);
        visit.direction(light.axis);
        visit.direction(light.zero);
    }
};

/// Of a number or a colour; an illuminant stays as it is.
LightColour scaled(LightColour colour, double factor);

/// In the order of help texts.
using Light =
    std::variant<SphereLight, CosinePowerLight, HemisphereLight, DiscLight, PlaneLight, LampLight>;

struct Lights {
    std::shared_ptr<const EnvironmentMap> environment;  ///< excludes `constant`
    double constant = 0;                                ///< radiance from everywhere
    std::optional<LinearPolarisation> polarisation;     ///< of the environment or constant
    std::vector<Light> sources;
};

/// Calls f.template operator()<L>() for every light type.
template <class F>
void for_each_light_type(F&& f) {
    [&]<class... L>(const std::variant<L...>*) {
        (f.template operator()<L>(), ...);
    }(static_cast<const Light*>(nullptr));
}

template <class L, class AnyLights>
auto lights_of_type(AnyLights& lights) {
    return lights.sources |
           std::views::filter([](const Light& light) { return std::holds_alternative<L>(light); }) |
           std::views::transform([](auto& light) -> auto& { return std::get<L>(light); });
}
/// The n-th source of type L, which must exist.
template <class L, class AnyLights>
auto& nth_light(AnyLights& lights, std::size_t n) {
    auto of_type = lights_of_type<L>(lights);
    auto at = of_type.begin();
    std::ranges::advance(at, std::ptrdiff_t(n));
    return *at;
}
template <class L>
std::size_t count_lights(const Lights& lights) {
    return std::size_t(std::ranges::distance(lights_of_type<L>(lights)));
}

const LightColour& colour_of(const Light& light);
LightColour& colour_of(Light& light);
/// Near lights hide the distant ones behind them, and the nearest wins. Distant lights add up.
bool is_near(const Light& light);
/// True if the radiance jumps at the light's edge.
bool has_edge(const Light& light);
bool polarised(const Lights& lights);

/// Radiance at each wavelength node.
std::vector<double> radiance_of(const LightColour& colour, const WavelengthSet& wavelengths);

/// A direction is in the cap if the cosine of its angle to the axis is in (to, from].
struct DiscCosines {
    double from = 2, to = -2;
};
DiscCosines cosines_of(const DiscLight& cap);

/// Distance along a ray (unit direction) to a near light; infinite when the ray misses.
double distance_to(const SphereLight& sphere, const Vec3& origin, const Vec3& direction);
double distance_to(const PlaneLight& plane, const Vec3& origin, const Vec3& direction);
double distance_to(const LampLight& lamp, const Vec3& origin, const Vec3& direction);
/// Part of a lamp's greatest radiance along rays of a direction (unit, towards the lamp).
double share_of(const LampLight& lamp, const Vec3& direction);
/// A sphere, or a lamp as a sphere of its greatest radiance.
std::optional<SphereLight> ball_of(const Light& light);
/// Part of a distant light's radiance that comes from a direction (unit, towards the light).
double share_of(const CosinePowerLight& lobe, const Vec3& direction);
double share_of(const HemisphereLight& half, const Vec3& direction);
double share_of(const DiscLight& cap, const DiscCosines& cosines, const Vec3& direction);

/// Adds lights that cover the places where this light's radiance jumps or falls steeply, `width`
/// radians wide as seen from `from`. The search for small features samples along them.
void add_rims(const DiscLight& cap, const Vec3& from, double width, std::vector<Light>& rims);
void add_rims(const HemisphereLight& half, const Vec3& from, double width,
              std::vector<Light>& rims);
void add_rims(const PlaneLight& plane, const Vec3& from, double width, std::vector<Light>& rims);
void add_rims(const LampLight& lamp, const Vec3& from, double width, std::vector<Light>& rims);
void add_rims(SphereLight sphere, const Vec3& from, double width, std::vector<Light>& rims);
void add_rims(CosinePowerLight lobe, const Vec3& from, double width, std::vector<Light>& rims);

}  // namespace culet
