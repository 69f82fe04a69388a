#pragma once
// What is to be rendered: a stone, what stands around it, a camera and lights. Lengths in the
// stone's unit, angles in radians.

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

class WorkMeter;  // work_meter.h

/// What stands between the stone and the eye. Angles are in the picture, counter-clockwise from its
/// x (to the right).
struct EyeOptics {
    std::optional<double> analyzer;  ///< direction of vibration that passes, radians
    /// A plate in front of the analyser: the wave along `slow_axis` falls behind by so much.
    struct Retarder {
        double retardation_nm = 0, slow_axis = 0;
    };
    std::optional<Retarder> retarder;
    /// A dichroscope: two windows side by side, of the analyser's direction and of the one at right
    /// angles to it.
    bool two_windows = false;
};

struct Camera {
    Vec3 position{0, 0, 40};
    Vec3 look_at{0, 0, 0};
    Vec3 up{0, 1, 0};
    double fov = 0.35;                         ///< vertical, radians; unused when orthographic
    std::optional<double> orthographic_width;  ///< of the picture's width
    int width = 400, height = 400;
    /// Where the line of sight (from `position` to `look_at`) meets the picture, pixels from its
    /// upper left corner, x to the right, y down; none: the picture's middle. A cropped photograph
    /// needs it, or a shifted lens.
    std::optional<std::array<double, 2>> principal_point = {};
    double aperture_radius = 0, focus_distance = 0;  ///< 0: pinhole
    /// A conoscope: every ray passes through `look_at`, and the picture shows directions, with the
    /// sine of the angle to the view's axis proportional to the distance from the middle; this
    /// angle (radians) is at the middle of the shorter edge. A pupil is then a disc around
    /// `look_at`.
    std::optional<double> cone;
    EyeOptics optics;
};

/// The principal point, wherever it comes from.
inline std::array<double, 2> line_of_sight_in(const Camera& camera) {
    return camera.principal_point.value_or(
        std::array<double, 2>{0.5 * camera.width, 0.5 * camera.height});
}

struct EyeRay {
    Vec3 origin, direction;  ///< unit direction, from the eye into the scene
};

/// The picture's right and up as two directions of vibration of a ray: turned with the view's axis
/// into the ray, by the least rotation, as a lens turns them.
struct EyeFrame {
    Vec3 x, y;
};

/// The ray through a point of the picture: x to the right 0..width, y down 0..height (pixel centres
/// at half integers), and a point of the unit disc of the pupil.
class EyeRays {
public:
    explicit EyeRays(const Camera& camera);
    EyeRay through(double x, double y, double pupil_x = 0, double pupil_y = 0) const;
    /// False in the corners of a conoscope's picture that are no direction.
    bool sees(double x, double y) const;
    EyeFrame frame(const Vec3& direction) const;

private:
    Camera camera_;
    std::array<double, 2> middle_;
    Vec3 right_, down_,
        forward_;  // right_ and down_ span one pixel at unit distance (or in length, or in sine)
};

enum class Effects : std::uint8_t {
    dispersion,
    birefringence,
    polarization,
    absorption,
    pleochroism,
    aperture,
    coherence  ///< of the two waves of a crystal
};
constexpr int k_effect_count = 7;
const char* name_of(Effects effect);

/// How beams follow refraction at the front facets.
enum class Refraction {
    astigmatic,   ///< to first order about the middle of every beam
    perspective,  ///< one virtual eye a front facet (Voelker & Hamann's perspective refraction)
    parallel      ///< one direction a front facet (Voelker & Hamann's parallel refraction)
};

/// What becomes of the two waves of a crystal in beams.
enum class CrystalBeams {
    merged,  ///< they go one way (Guy & Soler 2004, 4.2), and keep polarisation and coherence
    split    ///< each goes its own way, and their powers are added
};

/// About ten seconds of two cores, in the nanoseconds of work/price.h: what `culet render` allows.
constexpr double k_usual_budget_ns = 2e10;

/// What is done to find out how near a picture is to the truth, where that is left to culet.
enum class Check {
    none,      ///< nothing: drawn once
    estimate,  ///< drawn once, and held against the truth at some pixels
    full       ///< drawn more finely until these pixels say that it is near enough
};

enum class PixelFilter { box, tent, gaussian };

/// Deepest path that a scene may ask for, and that is followed where the tolerance decides.
constexpr int k_deepest = 1000;

struct RenderSettings {
    std::string engine = k_auto_engine;  ///< engine_name.h
    Refraction refraction = Refraction::astigmatic;
    /// Beams in crystals: nothing: whichever the scene calls for.
    std::optional<CrystalBeams> crystal_beams;
    int depth = 0;            ///< 0: by tolerance. Depth d has d - 1 inner segments
    double tolerance = 0.01;  ///< of the picture's mean radiance; 0: nothing is cut
    /// Weight below which a path is not followed (crystals: roulette), and above which both
    /// branches of a crystal's tree are; nothing: by tolerance.
    std::optional<double> cut_weight, split_weight;
    /// Whether light that has left a stone that is not convex may meet it again. Off, in isotropic
    /// stones: several times faster, for pictures that must come at once.
    bool meets_again = true;
    /// Largest radiance that a diffuse or rough surface is lit with by light that reached it by way
    /// of other things; nothing: as much as there is. Dots that brighten a dark place by chance go,
    /// and some light goes with them.
    std::optional<double> clamp_indirect;
    /// Reference: the rays of a pixel take turns, so that each carries every so manieth of the
    /// wavelengths that go ways of their own; at most `samples`. Nothing: 1, or where things stand
    /// around the stone, so that each wavelength has four rays.
    std::optional<int> wavelength_turns;
    /// Beams of one wavelength's tree, isotropic or merged: what memory they may take, some 100
    /// bytes each. Where there would be more, more of the light is cut.
    long long most_beams = 1 << 23;
    Check check = Check::full;
    /// Beams: pixels that are held against the reference, and its rays in each; 0: some 2000, 16.
    int checked_pixels = 0, checked_samples = 0;
    bool effects_auto = true;  ///< all that can matter; else `effects`
    std::array<bool, k_effect_count> effects{true, true, true, true, true, true, true};
    /// Coherence of a crystal's two waves: nothing: where the scene calls for it.
    std::optional<bool> coherence;
    /// Of the light at each wavelength; nothing: the distance of the wavelengths, 0 for a single
    /// one.
    std::optional<double> bandwidth_nm;
    std::vector<double> wavelengths_nm;  ///< empty: as many as the scene calls for
    int samples = 0;                     ///< a pixel; 0: 16, or 64 with an aperture
    /// Ray tables: constant factors on what a face reflects and lets through, instead of Fresnel's
    /// (Lee 2004, R- and T-factor); total reflection stays total.
    std::optional<double> reflection_factor, transmission_factor;
    /// Where the ray table is kept: read where there is one, else written. Empty: nowhere.
    std::string ray_table;
    PixelFilter filter = PixelFilter::box;
    double filter_radius = 0.5;  ///< pixels; the gaussian's is two standard deviations
    std::uint64_t seed = 1;
    int threads = 0;
    bool spectral = false;  ///< keep spectral planes
    /// Processor time that a picture may take, in the nanoseconds of work/price.h, where the scene
    /// is planned: the tolerance is then what that allows, `tolerance` at the finest. 0: as long as
    /// it takes.
    double allowed_ns = 0;
    std::shared_ptr<WorkMeter> meter;  ///< of drawing under way; counts nothing where there is none
};

struct Scene {
    /// The stone that the scene is about. Without facets: there is none, and objects alone.
    Stone stone;
    std::vector<Stone> more_stones;  ///< beside it, where they stand
    std::vector<SceneObject> objects;
    Camera camera;
    Lights lights;
    double immersion = 1;  ///< refractive index of what surrounds the stone
    RenderSettings settings;
    PlainShading shading;  ///< of the engines that are plain shadings
    /// How its PNGs are looked at; who writes them sets the exposure and the angle of a pixel.
    PngLook film;
    std::vector<std::string> notes;  ///< said on reading: negative texels clamped, ...
    /// Of its lights, where it names one (light_presets.h).
    std::string light_preset;
    /// A tolerance was asked for; else settings.tolerance is a default.
    bool names_tolerance = false;

    bool has_stone() const { return !stone.solid.facets.empty(); }
    /// False: the stone stands alone among the lights.
    bool has_objects() const { return !objects.empty() || !more_stones.empty(); }
};

}  // namespace culet
