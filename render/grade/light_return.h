#pragma once
// Light return under the trade's lighting models: GemRay's (R. W. Strickland, GemRay 1.2.0,
// raytracer.cpp) and one weighted like GIA's (Hemphill, Reinitz, Johnson and Shigley, Gems &
// Gemology 34 (1998) 158).
//
// Let d be the cosine between the line of sight and the direction along which a part of the eye's
// light exits. Parts count if 0 < d <= cos(head); the viewer's head is black. The weights are
//   iso 1;  cos d;  sc2 2 d sqrt(1 - d^2);  random sc2 times an uneven sky with spots (RandomSky)
// wlr counts d^2 for d > 0, without the head and the outer reflection, which the others include. It
// is for one line of sight; GIA's, for observers all around above the stone, is `weighted_return`.

#include <array>
#include <vector>

#include "render/grade/eye_light.h"
#include "render/grade/random_sky.h"

namespace culet {

enum class LightModel { iso, cos, sc2, random, wlr };
constexpr int k_light_model_count = 5;
const char* name_of(LightModel model);

/// By LightModel. 1: all of the eye's light returns where the model is brightest (random may exceed
/// 1).
using LightReturn = std::array<double, k_light_model_count>;

struct ViewReturn {
    LightReturn whole{};  ///< mean over the silhouette
    LightReturn table{};  ///< over the table; 0 if the table is not visible
};

/// `table`: facet index, or -1. `head`: half angle, radians.
ViewReturn light_return(const EyeLight& light, int table, double head, const RandomSky& sky);

/// Contribution of one direction to GIA's weighted light return: diffuse light from the upper
/// hemisphere, weighted with cos^2 of the exit angle to the vertical, without outer reflection. The
/// result is the sum of `returned` over that of `weight`.
struct WeightedReturn {
    double returned = 0, weight = 0;
};
WeightedReturn weighted_return(const EyeLight& light);

/// Balance of the eye's light, as fractions that sum to 1. The crown consists of the facets that
/// face up. Angles are to the line of sight.
struct LightBalance {
    double useful = 0;  ///< from the crown, between the head's cone and `view_cone`
    double head = 0;    ///< from the crown into the cone of the viewer's head
    double other = 0;   ///< from the crown beyond `view_cone`
    double leak = 0;    ///< from pavilion and girdle
    double entry_reflection = 0;
    double residual = 0;  ///< not followed to the end
};

struct BalanceCones {
    double head = 0;  ///< half angles, radians
    double view_cone = 0;
};

/// `crown`: per facet of the solid, whether it faces up.
LightBalance light_balance(const EyeLight& light, const std::vector<bool>& crown,
                           const BalanceCones& cones);

}  // namespace culet
