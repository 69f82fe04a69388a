#pragma once
// How much of the light around it a stone returns to the eye, in the lights that the trade
// computes with: GemRay's models (R. W. Strickland, GemRay 1.2.0, raytracer.cpp) and a light return
// weighted as GIA's (Hemphill, Reinitz, Johnson and Shigley, Gems & Gemology 34 (1998) 158).
//
// With d the cosine between the line of sight and the direction that a share of the eye's light
// leaves along; shares count where 0 < d <= cos(head), the viewer's head being black:
//   iso 1;  cos d;  sc2 2 d sqrt(1 - d^2);  random sc2 times an uneven sky with spots (RandomSky)
// wlr counts d^2 where d > 0: no head, and nothing of what the outside of the stone reflects. It is
// that of one line of sight; GIA's, of observers all around above the stone, is `weighted_return`.
// The others count the outer reflection too.

#include <array>
#include <vector>

#include "render/grade/eye_light.h"
#include "render/grade/random_sky.h"

namespace culet {

enum class LightModel { iso, cos, sc2, random, wlr };
constexpr int k_light_model_count = 5;
const char* name_of(LightModel model);

/// By LightModel: 1 where all of the eye's light comes back to where the model is brightest
/// (random: may be more).
using LightReturn = std::array<double, k_light_model_count>;

struct ViewReturn {
    LightReturn whole{};  ///< mean over the silhouette
    LightReturn table{};  ///< over the table; 0 where it is not seen
};

/// `table`: facet index, or -1. `head`: half angle, radians.
ViewReturn light_return(const EyeLight& light, int table, double head, const RandomSky& sky);

/// One direction's part in GIA's weighted light return: diffuse light from the hemisphere above
/// the stone, what the hemisphere gets of it weighted with cos^2 of the angle to the vertical, what
/// the outside reflects left out. Of all directions the sum of `returned` over that of `weight`.
struct WeightedReturn {
    double returned = 0, weight = 0;
};
WeightedReturn weighted_return(const EyeLight& light);

/// Where a unit of the eye's light goes; the parts sum to 1. Fractions; crown: through facets that
/// look up. Angles are to the line of sight.
struct LightBalance {
    double useful = 0;  ///< out of the crown, between the head's cone and `view_cone`
    double head = 0;    ///< out of the crown into the cone of the viewer's head
    double other = 0;   ///< out of the crown beyond `view_cone`
    double leak = 0;    ///< out of pavilion and girdle
    double entry_reflection = 0;
    double residual = 0;  ///< not followed to the end
};

struct BalanceCones {
    double head = 0;  ///< half angles, radians
    double view_cone = 0;
};

/// `crown`: by facet of the solid, whether it looks up.
LightBalance light_balance(const EyeLight& light, const std::vector<bool>& crown,
                           const BalanceCones& cones);

}  // namespace culet
