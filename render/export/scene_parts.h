#pragma once
// What the writers of scenes for other renderers share. Lengths in the stone's unit.

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/image/picture.h"
#include "render/scene/scene.h"

namespace culet {

/// A scene in the language of another renderer, and the files that it names.
struct ExportedScene {
    std::string text;
    std::vector<std::string> notes;  ///< what of the scene is not in it, one line each
    std::vector<std::pair<std::string, std::string>> meshes;     ///< names beside it, and texts
    std::optional<std::pair<std::string, Picture>> environment;  ///< name, and the distant lights
};

/// Sizes of the scene: as far as an infinite plane reaches where there is none.
inline constexpr double k_far_away = 1000;

/// Once.
void add_note(std::vector<std::string>& notes, const std::string& note);

/// Throws InputError for what no other renderer has: conoscopes, what stands before the eye,
/// polarised lights.
void refuse_instruments(const Scene& scene, const std::string& program);

/// What the renderer draws of a stone: of a convex one the planes, whose corners are computed anew
/// where they lie off them by more than single precision shows.
Solid drawn_solid(const Stone& stone);

/// Counter-clockwise from outside.
TriangleMesh triangles_of(const Solid& solid);
TriangleMesh triangles_of(const BoxShape& box);

/// Of the stone, or how far the eye is from what it looks at.
double size_of(const Scene& scene);

/// The picture's axes: where the line of sight goes, and unit vectors to the right and up.
struct CameraAxes {
    Vec3 forward, right, up;
};
CameraAxes axes_of(const Camera& camera);

/// Half-extents of a rectangle, or two unit vectors, whose cross product is along a normal.
struct InPlane {
    Vec3 u, v;
};
/// Any two unit vectors in the plane of that normal (unit).
InPlane in_plane(const Vec3& normal);
/// Of a light: infinite ones end `far` away.
InPlane extent_of(const PlaneLight& plane, double far);

/// What RGB the lights of a scene have for a renderer that knows no more.
class LightRgb {
public:
    explicit LightRgb(const Scene& scene);
    bool one_wavelength() const { return one_wavelength_; }
    /// `notes`: that a spectrum is its colour only.
    Rgb of(const LightColour& light, std::vector<std::string>& notes) const;

private:
    bool one_wavelength_;
    WavelengthSet colours_;
};

/// All lights but near ones, in linear light.
class DistantLights {
public:
    /// `lights` must outlive this. `notes`: as LightRgb::of.
    DistantLights(const Lights& lights, const LightRgb& rgb, std::vector<std::string>& notes);
    /// The same from everywhere.
    bool is_even() const;
    /// A light ends within a texel of a map.
    bool has_edges() const;
    /// From a direction (unit, towards the light).
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

/// A picture of the distant lights, each texel the mean over 4 x 4 places in it. `direction`: the
/// unit vector at a place of the picture, column 0..width, row 0..height.
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

/// "scene" of "my scene.xml" as a name without blanks and signs, for files beside it.
std::string plain_stem(const std::string& stem);

}  // namespace culet
