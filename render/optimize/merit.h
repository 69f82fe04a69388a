#pragma once
// The merit of a cut: one number that varies continuously with its angles.

#include <map>
#include <string>
#include <vector>

#include "render/grade/grade.h"

namespace culet {

/// Parts of a merit, each a percentage.
enum class MeritPart {
    brilliance,  ///< light return, mean over the tilts
    fire,        ///< part of the light with at least 0.25 degrees between red and blue
                 ///< (Fire::separated)
    contrast,    ///< part of the crown that reflects the viewer's head (ASET's blue)
    tilt,        ///< light return at 20 degrees relative to face up, at most 100
};
inline constexpr int k_merit_part_count = 4;
const char* name_of(MeritPart part);

struct MeritOptions {
    GradeIndex index;
    LightModel model = LightModel::cos;
    double head = radians(10);  ///< half angle of the viewer's head
    std::array<double, k_merit_part_count> weights{1, 0, 0, 0};
    int threads = 0;
};

struct Merit {
    std::array<double, k_merit_part_count> parts{};  ///< per cent; 0 where its weight is 0
    double total = 0;                                ///< weighted mean
};

/// Reads "brilliance", or weighted parts: "brilliance=2,fire=1". Throws InputError.
std::array<double, k_merit_part_count> merit_weights(const std::string& text);

/// `convex`: closed and convex, table up. Tilts: 0, 10, 20 and 30 degrees to both sides about the x
/// axis, as in GemRay's optimiser.
Merit merit_of(const Solid& convex, const MeritOptions& options);

}  // namespace culet
