#pragma once
// The alternatives that a calibration photographs: the model with other facets, light, pose or
// material, or one thing wrong.

#include <glm/mat3x3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/calibration/calibration.h"
#include "compare/scores/chance.h"
#include "render/scene/scene.h"

namespace culet {

struct AlternativeOptions {
    int draws = 8;        ///< at each facet error
    int null_draws = 24;  ///< of each null
    std::uint64_t seed = 1;
    std::optional<Solid> start{};  ///< where the fit started: the catalogue's cut
    /// Standard uncertainty of the pose about either axis across the line of sight, radians. Every
    /// draw except a wrong pose is turned at random by it.
    double view_sigma = 0;
};

struct AlternativeDraw {
    Alternative alternative = Alternative::facet_error;
    std::string name;
    double facet_error_deg = 0;
    std::uint64_t seed = 0;
    int which = 0;  ///< index among the alternatives of this kind
};

class Alternatives {
public:
    /// Adds to `notes` which alternatives there are none of, and why. The model must outlive this.
    Alternatives(const Scene& model, const AlternativeOptions& asked,
                 std::vector<std::string>& notes);

    /// All kinds come up early, in case the time budget runs out.
    const std::vector<AlternativeDraw>& draws() const { return draws_; }
    Scene scene_of(const AlternativeDraw& draw) const;

private:
    glm::dmat3 wrong_pose(Chance& chance) const;
    void make_wrong(Scene& scene, int which, Chance& chance) const;
    glm::dmat3 unsure_view(Chance& chance) const;

    const Scene& model_;
    Vec3 middle_;
    double view_sigma_ = 0;
    int turns_alike_ = 1;
    std::optional<Solid> catalogue_;
    std::vector<Material> neighbours_;
    std::vector<AlternativeDraw> draws_;
};

}  // namespace culet
