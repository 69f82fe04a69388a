#pragma once
// Directions towards the lights: for surfaces that see light from everywhere, of which the lights
// are a small part.

#include <optional>
#include <vector>

#include "render/objects/surface.h"
#include "render/scene/scene.h"

namespace culet {

/// Chooses directions by a mixture of densities, one a light. What shines from everywhere or from
/// half of it is left to the surface's own choice of directions. May be asked from any thread.
class LightSampler {
public:
    explicit LightSampler(const Scene& scene);

    bool empty() const { return parts_.empty(); }
    /// Nothing: the light chosen cannot be aimed at from here.
    std::optional<Vec3> sample(const Vec3& from, Random& random) const;
    /// Of `sample`, per solid angle.
    double density(const Vec3& from, const Vec3& direction) const;

private:
    /// Anything in a ball (as the cone that it fills).
    struct Ball {
        Vec3 center;
        double radius;
    };
    /// A flat light, by its area.
    struct Flat {
        Vec3 center, normal, u, v;  ///< half-extents, or two radii of a disc at right angles
        bool round;
        double area;
    };
    /// A ring of directions about an axis.
    struct Ring {
        Vec3 axis;
        double from_cosine, to_cosine;  ///< from > to
    };
    struct Lobe {
        Vec3 axis;
        double exponent;
    };
    /// The brightness of an environment, by cells of equal angles.
    struct Sky {
        int width = 0, height = 0;
        std::vector<double> sums;     ///< of the shares, up to and with each cell
        std::vector<double> density;  ///< per solid angle, in each cell
    };
    using Part = std::variant<Ball, Flat, Ring, Lobe, Sky>;
    static std::optional<Vec3> sample(const Ball& ball, const Vec3& from, Random& random);
    static std::optional<Vec3> sample(const Flat& flat, const Vec3& from, Random& random);
    static std::optional<Vec3> sample(const Ring& ring, const Vec3& from, Random& random);
    static std::optional<Vec3> sample(const Lobe& lobe, const Vec3& from, Random& random);
    static std::optional<Vec3> sample(const Sky& sky, const Vec3& from, Random& random);
    static double density(const Ball& ball, const Vec3& from, const Vec3& direction);
    static double density(const Flat& flat, const Vec3& from, const Vec3& direction);
    static double density(const Ring& ring, const Vec3& from, const Vec3& direction);
    static double density(const Lobe& lobe, const Vec3& from, const Vec3& direction);
    static double density(const Sky& sky, const Vec3& from, const Vec3& direction);

    void add(Part part, double power);
    void add_lights(const Lights& lights, const Vec3& about);
    void add_sky(const EnvironmentMap& map);
    void add_emitters(const std::vector<SceneObject>& objects, const Vec3& about);

    std::vector<Part> parts_;
    std::vector<double> share_;  ///< that each is chosen with
};

}  // namespace culet
