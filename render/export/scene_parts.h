#pragma once
// Shared by the writers of scenes for other renderers. Lengths in the stone's unit.

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/image/picture.h"
#include "render/scene/scene.h"

namespace culet {

/// A scene in another renderer's language, and the files that it refers to.
struct ExportedScene {
    std::string text;
    std::vector<std::string> notes;                           ///< what was left out, one line each
    std::vector<std::pair<std::string, std::string>> meshes;  ///< file names beside the scene,
                                                              ///< and texts
    std::optional<std::pair<std::string, Picture>> environment;  ///< file name, and the distant
                                                                 ///< lights
};

/// Extent of infinite planes in renderers without them, in sizes of the scene.
inline constexpr double k_far_away = 1000;

/// Adds the note unless it is there already.
void add_note(std::vector<std::string>& notes, const std::string& note);

/// Throws InputError for what no other renderer supports: conoscopes, optics before the eye,
/// polarised lights.
void refuse_instruments(const Scene& scene, const std::string& program);

/// The stone as culet draws it: of a convex one the planes, with corners recomputed if they are
/// farther off them than single precision shows.
Solid drawn_solid(const Stone& stone);

/// Counter-clockwise from outside.
TriangleMesh triangles_of(const Solid& solid);
TriangleMesh triangles_of(const BoxShape& box);

/// The stone's size, or without a stone the distance from the eye to its target.
double size_of(const Scene& scene);

/// Direction of the line of sight, and unit vectors right and up.
struct CameraAxes {
    Vec3 forward, right, up;
};
CameraAxes axes_of(const Camera& camera);

/// Half-extents of a rectangle, or two unit vectors; u x v is along the normal.
struct InPlane {
    Vec3 u, v;
};
/// Two unit vectors in the plane of the unit `normal`.
InPlane in_plane(const Vec3& normal);
/// Of a light; infinite ones end at the distance `far`.
InPlane extent_of(const PlaneLight& plane, double far);

/// Converts the colours of lights to RGB, for renderers without spectra.
class LightRgb {
public:
    explicit LightRgb(const Scene& scene);
    bool one_wavelength() const { return one_wavelength_; }
    /// Adds a note if only the colour of a spectrum is kept.
    Rgb of(const LightColour& light, std::vector<std::string>& notes) const;

private:
    bool one_wavelength_;
    WavelengthSet colours_;
};

/// All lights except near ones, in linear RGB.
class DistantLights {
public:
    /// `lights` must outlive this. `notes`: as in LightRgb::of.
    DistantLights(const Lights& lights, const LightRgb& rgb, std::vector<std::string>& notes);
    /// True if the light is the same from everywhere.
    bool is_even() const;
    /// True if a light has a sharp edge, which a map's texels blur.
    bool has_edges() const;
    /// Radiance from a direction (unit, towards the light).
    Rgb from(const Vec3& direction) const;

private:
    struct Part {
        const Light* light;
        Rgb colour;
        DiscCosines cosines;  // of a cap
    };
    const Lights& lights_;
    std::vector<Part> parts_;
};

/// Map of the distant lights; each texel is the mean over 4 x 4 points. `direction`: unit vector at
/// a place of the map, column 0..width, row 0..height.
template <class DirectionAt>
Picture distant_light_map(const DistantLights& lights, int width, int height,
                          const DirectionAt& direction) {
    constexpr int k_places = 4;
    Picture map;
    map.width = width;
    map.height = height;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Rgb sum{};
            for (int k = 0; k < k_places * k_places; ++k) {
                const double column = x + (k % k_places + 0.5) / k_places;
                const double row = y + (k / k_places + 0.5) / k_places;
                const Rgb one = lights.from(direction(column, row));
                for (std::size_t c = 0; c < 3; ++c) sum[c] += one[c] / (k_places * k_places);
            }
            for (const double value : sum) map.rgb.push_back(static_cast<float>(value));
        }
    }
    return map;
}

/// "scene" from "my scene.xml": a stem without blanks and signs, for files beside it.
std::string plain_stem(const std::string& stem);

}  // namespace culet
