#pragma once
// The table behind "what does this score mean": the scores that simulated photographs of known
// worlds reach against the model's render.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace culet {

enum class World {
    facet_error,  ///< the model with its facets tilted: the sensitivity curve; 0 is the ceiling
    light,        ///< the model under its lights turned by 15 to 180 degrees
    pose,         ///< the model turned and tilted, registered anew
    both,         ///< the two at once
    catalogue,    ///< the model's most symmetrical neighbour, or the mesh that the fit started from
    material,     ///< neighbours in the catalogue
    wrong         ///< one thing a little wrong: index, dispersion, absorption, light, tilt
};
const char* name_of(World world);

struct CalibrationDraw {
    World world = World::facet_error;
    std::string name;            ///< "0.1 degrees", "quartz", "no dispersion"; nulls: empty
    double facet_error_deg = 0;  ///< of World::facet_error
    /// One a key; nothing: not defined for this picture, or it could not be laid on the model.
    std::vector<std::optional<double>> scores;
};

struct Calibration {
    std::vector<std::string> keys;  ///< of the scores
    std::vector<CalibrationDraw> draws;
    std::uint64_t seed = 1;
    double stone_px = 0;   ///< diameter of the stone in the pictures that were compared
    double psf_px = 0;     ///< standard deviation of the blur that its photographs were given
    double electrons = 0;  ///< that their noise stands for, at the clipping level
    bool from_cache = false;
    std::string hash;  ///< of everything that it depends on
    std::vector<std::string> notes;
};

/// As text for a cache file, and back; nothing for text that is no such thing or of another
/// version.
std::string calibration_json(const Calibration& calibration);
std::optional<Calibration> calibration_from(const std::string& json);

}  // namespace culet
