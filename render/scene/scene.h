#pragma once
// The scene to render: stones, objects, camera, lights and settings. Lengths in the stone's unit,
// angles in radians.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "render/image/film_look.h"
#include "render/scene/engine_name.h"
#include "render/scene/lights.h"
#include "render/scene/objects.h"
#include "render/scene/plain_shading.h"
#include "stone/stone.h"

namespace culet {

class WorkMeter;  // render/work/work_meter.h

/// Analyser and retarder between stone and eye. Angles are in the picture, counter-clockwise from x
/// (right).
struct EyeOptics {
    std::optional<double> analyzer;  ///< direction of vibration that passes, radians
    /// A plate in front of the analyser that delays the wave along `slow_axis` (radians).
    struct Retarder {
        double retardation_nm = 0, slow_axis = 0;
    };
    std::optional<Retarder> retarder;
    /// Dichroscope: two windows side by side, the second with the analyser turned by 90 degrees.
    bool two_windows = false;
};

struct Camera {
    Vec3 position{0, 0, 40};
    Vec3 look_at{0, 0, 0};
    Vec3 up{0, 1, 0};
    double fov = 0.35;                         ///< vertical, radians; unused when orthographic
    std::optional<double> orthographic_width;  ///< of the picture, a length
    int width = 400, height = 400;
    /// Where the line of sight (`position` to `look_at`) meets the picture, pixels from the upper
    /// left corner, x right, y down; none: the middle. For cropped photographs and shifted lenses.
    std::optional<std::array<double, 2>> principal_point = {};
    double aperture_radius = 0, focus_distance = 0;  ///< 0: pinhole
    /// Conoscope: all rays pass through `look_at` (with an aperture: a disc around it), and the
    /// sine of a ray's angle to the view's axis is proportional to the distance from the middle.
    /// This is the angle (radians) at the middle of the shorter edge.
    std::optional<double> cone;
    EyeOptics optics;
};

inline std::array<double, 2> line_of_sight_in(const Camera& camera) {
    return camera.principal_point.value_or(
        std::array<double, 2>{0.5 * camera.width, 0.5 * camera.height});
}

struct EyeRay {
    Vec3 origin, direction;  ///< unit direction, from the eye into the scene
};

/// The picture's right and up as vibration directions of a ray, turned by the least rotation from
/// the view's axis to the ray, as in a lens.
struct EyeFrame {
    Vec3 x, y;
};

/// Rays through points of the picture: x right, 0..width; y down, 0..height (pixel centres at half
/// integers); pupil points in the unit disc.
class EyeRays {
public:
    explicit EyeRays(const Camera& camera);
    EyeRay through(double x, double y, double pupil_x = 0, double pupil_y = 0) const;
    /// False in the corners of a conoscope's picture, which show no direction.
    bool sees(double x, double y) const;
    EyeFrame frame(const Vec3& direction) const;

private:
    Camera camera_;
    std::array<double, 2> middle_;
    Vec3 right_, down_,
        forward_;  // right_, down_: one pixel at unit distance (or as length, or sine)
};

enum class Effects : std::uint8_t {
    dispersion,
    birefringence,
    polarization,
    absorption,
    pleochroism,
    aperture,
    coherence  ///< between a crystal's two waves
};
constexpr int k_effect_count = 7;
const char* name_of(Effects effect);

/// How beams model refraction at the front facets.
enum class Refraction {
    astigmatic,   ///< to first order about the middle of every beam
    perspective,  ///< one virtual eye per front facet (Voelker & Hamann's perspective refraction)
    parallel      ///< one direction per front facet (Voelker & Hamann's parallel refraction)
};

/// How beams treat the two waves of a crystal.
enum class CrystalBeams {
    merged,  ///< they share one path (Guy & Soler 2004, 4.2) and keep polarisation and coherence
    split    ///< each has its own path, and their powers add
};

/// Default time budgets: of `culet render`, about three seconds of two cores (in the light
/// `photograph`, pictures take up to 1.9 times their price); of stones for which these are too few,
/// and of the pictures of `culet run`, about ten. In the nanoseconds of work/price.h.
constexpr double k_usual_budget_ns = 4e9, k_run_budget_ns = 2e10;

/// How culet checks a picture's error.
enum class Check {
    none,      ///< draws once, checks nothing
    estimate,  ///< draws once, and estimates the error at some pixels against the reference
    full       ///< refines until the error estimated at these pixels is small enough
};

enum class PixelFilter { box, tent, gaussian };

/// Largest depth, given by a scene or chosen by tolerance.
constexpr int k_deepest = 1000;

struct RenderSettings {
    std::string engine = k_auto_engine;  ///< engine_name.h
    Refraction refraction = Refraction::astigmatic;
    /// Beams in crystals. Nothing: chosen by the scene.
    std::optional<CrystalBeams> crystal_beams;
    int depth = 0;            ///< 0: by tolerance. A path of depth d has d - 1 inner segments
    double tolerance = 0.01;  ///< relative to the picture's mean radiance; 0: no path is cut
    /// Paths of weight below `cut_weight` are not followed (crystals: Russian roulette). Above
    /// `split_weight`, both branches of a crystal's tree are followed. Nothing: by tolerance.
    std::optional<double> cut_weight, split_weight;
    /// Light that has left a non-convex stone may enter it again. Off, isotropic stones draw
    /// several times faster (interactive pictures).
    bool meets_again = true;
    /// Limit of indirect radiance on diffuse and rough surfaces; nothing: none. It removes
    /// fireflies, and some light with them.
    std::optional<double> clamp_indirect;
    /// Reference: each ray of a pixel carries only every n-th wavelength, starting at each in turn;
    /// every wavelength has its own path; n is at most `samples`. Nothing: 1, or with objects,
    /// four rays per wavelength.
    std::optional<int> wavelength_turns;
    /// Limit on the beams of one wavelength's tree (isotropic or merged), some 100 bytes each. More
    /// light is cut to keep it.
    long long most_beams = 1 << 23;
    Check check = Check::full;
    /// Beams: pixels checked against the reference, and rays in each. 0: some 2000, and 16.
    int checked_pixels = 0, checked_samples = 0;
    bool effects_auto = true;  ///< all effects that can matter; else `effects`
    std::array<bool, k_effect_count> effects{true, true, true, true, true, true, true};
    /// Between a crystal's two waves. Nothing: chosen by the scene.
    std::optional<bool> coherence;
    /// Of the light at each wavelength. Nothing: the spacing of the wavelengths, 0 for a single
    /// one.
    std::optional<double> bandwidth_nm;
    std::vector<double> wavelengths_nm;  ///< empty: chosen by the scene
    int samples = 0;                     ///< per pixel; 0: 16, or 64 with an aperture
    /// Ray tables: constant factors on reflected and transmitted light in place of Fresnel's (Lee
    /// 2004, R- and T-factor); total reflection stays total.
    std::optional<double> reflection_factor, transmission_factor;
    /// File of the ray table: read if it exists, else written. Empty: not kept.
    std::string ray_table;
    PixelFilter filter = PixelFilter::box;
    double filter_radius = 0.5;  ///< pixels; two standard deviations of the gaussian
    std::uint64_t seed = 1;
    int threads = 0;
    bool spectral = false;  ///< keep spectral planes
    /// Processor time for a planned picture, in the nanoseconds of work/price.h; it sets the
    /// tolerance, but never finer than `tolerance`. 0: no limit.
    double allowed_ns = 0;
    std::shared_ptr<WorkMeter> meter;  ///< counts the drawing's work; may be null
};

struct Scene {
    /// The main stone; without facets, there are only objects.
    Stone stone;
    std::vector<Stone> more_stones;  ///< placed beside it
    std::vector<SceneObject> objects;
    Camera camera;
    Lights lights;
    double immersion = 1;  ///< refractive index of the surroundings
    RenderSettings settings;
    PlainShading shading;  ///< for flat, gouraud, phong and whitted
    /// For PNGs; the code that writes them sets exposure and angle of a pixel.
    PngLook film;
    std::vector<std::string> notes;  ///< from reading: negative texels clamped, ...
    /// Name of the lights' preset, if any (light_presets.h).
    std::string light_preset;
    /// False: settings.tolerance is a default.
    bool names_tolerance = false;

    bool has_stone() const { return !stone.solid.facets.empty(); }
    bool has_objects() const { return !objects.empty() || !more_stones.empty(); }
};

}  // namespace culet
