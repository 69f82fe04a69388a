#pragma once
// What shines on the stone: the one list of light types. Lengths in the stone's unit, angles in
// radians.
//
// A light type has a name, says how it shines (`distance_to` or `share_of` below) and of what parts
// it consists (`each_part`, by which lights are turned and compared). Whoever asks something else
// of every type (scene files, beams, export, their edges) asks it by std::visit, so that a type
// that was forgotten does not compile. CONTRIBUTING.md has the list.

#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <variant>
#include <vector>

#include "render/colour/colour.h"
#include "stone/solid/solid.h"

namespace culet {

/// Light that vibrates along one direction, as behind a polariser.
struct LinearPolarisation {
    Vec3 vibration{1, 0, 0};  ///< unit
    /// Normal of the polariser's sheet: rays at an angle to it vibrate along `vibration` turned
    /// with the normal into the ray. None: along the projection of `vibration`.
    std::optional<Vec3> normal;
    double degree = 1;  ///< 0..1 of the radiance; the rest is unpolarised
    /// Unit vibration of a ray that travels along or against the unit `direction`.
    Vec3 of_ray(const Vec3& direction) const;
};

/// What a light sends out: a number (D65 white), a colour, or an illuminant by name ("D65", "A").
/// The radiance is that behind the polariser, if there is one.
struct LightColour {
    std::variant<double, Rgb, std::string> value = 1.0;
    std::optional<LinearPolarisation> polarisation = {};
};

/// Radiance from all directions as a lat-long map. Frame (docs/rendering.md): the
/// top row +z, the middle column +x, azimuth growing to the left as seen from inside.
struct EnvironmentMap {
    int width = 0, height = 0;
    std::vector<float> rgb;
    /// Bilinear look-up at the centre-sampled texels; wraps in azimuth, clamps at the poles.
    Rgb at(const Vec3& direction) const;
};

/// Shines outwards, and inwards on what stands inside it (a dome).
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
/// Emits on the side of its normal; from the other side it is not there. `u`, `v` empty: infinite;
/// else the half-extents as vectors in it.
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

/// In the order in which people are told of them.
using Light = std::variant<SphereLight, CosinePowerLight, HemisphereLight, DiscLight, PlaneLight>;

struct Lights {
    std::shared_ptr<const EnvironmentMap> environment;  ///< or
    double constant = 0;                                ///< radiance from everywhere
    std::optional<LinearPolarisation> polarisation;     ///< of these two
    std::vector<Light> sources;
};

/// Calls f.template operator()<L>() for every light type.
template <class F>
void for_each_light_type(F&& f) {
    [&]<class... L>(const std::variant<L...>*) {
        (f.template operator()<L>(), ...);
    }(static_cast<const Light*>(nullptr));
}

/// The sources of one type, in their order.
template <class L, class AnyLights>
auto lights_of_type(AnyLights& lights) {
    return lights.sources |
           std::views::filter([](const Light& light) { return std::holds_alternative<L>(light); }) |
           std::views::transform([](auto& light) -> auto& { return std::get<L>(light); });
}
/// The n-th of them, which must be there.
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
/// Near lights hide the distant ones behind them; the nearest wins. Distant ones add up.
bool is_near(const Light& light);
/// Its radiance jumps from one direction to the next.
bool has_edge(const Light& light);
/// True when any light is polarised.
bool polarised(const Lights& lights);

/// Radiance at each node.
std::vector<double> radiance_of(const LightColour& colour, const WavelengthSet& wavelengths);

/// A cap is where the cosine of the angle to its direction is in (to, from].
struct DiscCosines {
    double from = 2, to = -2;
};
DiscCosines cosines_of(const DiscLight& cap);

/// Of near lights: how far along a ray (unit direction) they are; infinite when the ray misses.
double distance_to(const SphereLight& sphere, const Vec3& origin, const Vec3& direction);
double distance_to(const PlaneLight& plane, const Vec3& origin, const Vec3& direction);
/// Of distant ones: what share of the radiance comes from a direction (unit, towards the light).
double share_of(const CosinePowerLight& lobe, const Vec3& direction);
double share_of(const HemisphereLight& half, const Vec3& direction);
double share_of(const DiscLight& cap, const DiscCosines& cosines, const Vec3& direction);

/// Adds lights where the radiance of this one jumps or falls steeply, `width` (radians) wide as
/// seen from a point: the search for what few pixels show looks along them.
void add_rims(const DiscLight& cap, const Vec3& from, double width, std::vector<Light>& rims);
void add_rims(const HemisphereLight& half, const Vec3& from, double width,
              std::vector<Light>& rims);
void add_rims(const PlaneLight& plane, const Vec3& from, double width, std::vector<Light>& rims);
void add_rims(SphereLight sphere, const Vec3& from, double width, std::vector<Light>& rims);
void add_rims(CosinePowerLight lobe, const Vec3& from, double width, std::vector<Light>& rims);

}  // namespace culet
