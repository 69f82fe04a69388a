#pragma once
// Samples directions towards lights, which are a small part of the directions that light a surface.

#include <optional>
#include <vector>

#include "render/objects/surface.h"
#include "render/scene/scene.h"

namespace culet {

/// Chooses directions by a mixture of densities, one per light. Lights that cover all directions or
/// half of them are left to the surface's own sampling. Thread-safe.
class LightSampler {
public:
    explicit LightSampler(const Scene& scene);

    bool empty() const { return parts_.empty(); }
    /// Nothing: the chosen light cannot be sampled from here.
    std::optional<Vec3> sample(const Vec3& from, Random& random) const;
    /// Density of `sample`, per solid angle.
    double density(const Vec3& from, const Vec3& direction) const;

private:
    /// Anything in a ball, sampled as the cone that the ball subtends.
    struct Ball {
        Vec3 center;
        double radius;
    };
    /// A flat light, sampled by area.
    struct Flat {
        Vec3 center, normal, u, v;  ///< half-extents, or two perpendicular radii of a disc
        bool round;
        double area;
    };
    /// A ring of directions around an axis.
    struct Ring {
        Vec3 axis;
        double from_cosine, to_cosine;  ///< from > to
    };
    struct Lobe {
        Vec3 axis;
        double exponent;
    };
    /// An environment's brightness, in cells of equal angles.
    struct Sky {
        int width = 0, height = 0;
        std::vector<double> sums;     ///< cumulative probabilities, up to and including each cell
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
    std::vector<double> share_;  ///< probability of choosing each part
};

}  // namespace culet
