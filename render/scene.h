#pragma once
// What is to be rendered: a stone, a camera and lights. Lengths in the stone's unit, angles in
// radians.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "render/colour.h"
#include "stone/stone.h"

namespace culet {

struct Camera {
    Vec3 position{0, 0, 40};
    Vec3 look_at{0, 0, 0};
    Vec3 up{0, 1, 0};
    double fov = 0.35;                         ///< vertical, radians; unused when orthographic
    std::optional<double> orthographic_width;  ///< of the picture's width
    int width = 400, height = 400;
    double aperture_radius = 0, focus_distance = 0;  ///< 0: pinhole
};

struct EyeRay {
    Vec3 origin, direction;  ///< unit direction, from the eye into the scene
};

/// The ray through a point of the picture: x to the right 0..width, y down 0..height (pixel centres
/// at half integers), and a point of the unit disc of the pupil.
class EyeRays {
public:
    explicit EyeRays(const Camera& camera);
    EyeRay through(double x, double y, double pupil_x = 0, double pupil_y = 0) const;

private:
    Camera camera_;
    Vec3 right_, down_,
        forward_;  // right_ and down_ span one pixel at unit distance (or in length)
};

/// What a light sends out: a number (D65 white), a colour, or an illuminant by name ("D65", "A").
struct LightColour {
    std::variant<double, Rgb, std::string> value = 1.0;
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
    Vec3 center;
    double radius = 1;
    LightColour radiance;
};
struct LobeLight {
    Vec3 direction;
    double exponent = 1;
    LightColour radiance;
};
struct HemisphereLight {
    Vec3 direction;
    LightColour radiance;
};
/// Directions whose angle to `direction` is in [from, to).
struct CapLight {
    Vec3 direction;
    double from = 0, to = 0.0047;
    LightColour radiance;
};
/// Emits on the side of its normal; from the other side it is not there. `u`, `v` empty: infinite;
/// else the half-extents as vectors in it.
struct PlaneLight {
    Vec3 point, normal;
    std::optional<Vec3> u, v;
    LightColour radiance;
};

struct Lights {
    std::shared_ptr<const EnvironmentMap> environment;  ///< or
    double constant = 0;                                ///< radiance from everywhere
    std::vector<SphereLight> spheres;
    std::vector<LobeLight> lobes;
    std::vector<HemisphereLight> hemispheres;
    std::vector<CapLight> caps;
    std::vector<PlaneLight> planes;
};

/// The lights made ready for one set of wavelengths. Near lights (spheres, planes) hide the distant
/// ones behind them; the nearest wins. Distant ones add up.
class LightField {
public:
    LightField(const Lights& lights, const WavelengthSet& wavelengths);
    ~LightField();
    LightField(LightField&&) noexcept;

    /// Adds `weight` times the radiance that arrives along a ray (from `origin` looking along the
    /// unit `direction`) at node `first` .. `first + count - 1` to `radiance[0 .. count - 1]`.
    /// Returns the light's name for people: "environment", "sphere 0", ...
    void add_radiance(const Vec3& origin, const Vec3& direction, double weight, int first,
                      int count, double* radiance) const;
    std::string name_at(const Vec3& origin, const Vec3& direction) const;
    /// Largest radiance of any light at any node, for bounds.
    double max_radiance() const;

private:
    struct Ready;
    std::unique_ptr<Ready> ready_;
};

enum class Effects : std::uint8_t {
    dispersion,
    birefringence,
    polarization,
    absorption,
    pleochroism,
    aperture
};
constexpr int k_effect_count = 6;
const char* name_of(Effects effect);

struct RenderSettings {
    std::string engine = "auto";  ///< reference (auto means it, for now)
    int depth = 0;                ///< 0: by tolerance. Depth d has d - 1 inner segments
    double tolerance = 0.01;      ///< of the picture's mean radiance; 0: nothing is cut
    bool effects_auto = true;     ///< all that can matter; else `effects`
    std::array<bool, k_effect_count> effects{true, true, true, true, true, true};
    std::vector<double> wavelengths_nm;  ///< empty: as many as the scene calls for
    int samples = 16;                    ///< a pixel
    std::uint64_t seed = 1;
    int threads = 0;
    bool spectral = false;  ///< keep spectral planes
};

struct Scene {
    Stone stone;
    Camera camera;
    Lights lights;
    RenderSettings settings;
    std::vector<std::string> notes;  ///< said on reading: negative texels clamped, ...
};

}  // namespace culet
