#pragma once
// The scores that simulated photographs of known alternatives reach against the model's render.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace culet {

enum class Alternative {
    facet_error,  ///< tilted facets: the sensitivity curve; 0 degrees is the ceiling
    light,        ///< lights turned by 15 to 180 degrees
    pose,         ///< turned and tilted, registered anew
    both,         ///< wrong light and wrong pose
    catalogue,    ///< the most symmetrical neighbour, or the mesh that the fit started from
    material,     ///< neighbours in the catalogue of materials
    wrong         ///< one thing slightly wrong: index, dispersion, absorption, light, tilt
};
const char* name_of(Alternative alternative);

struct CalibrationDraw {
    Alternative alternative = Alternative::facet_error;
    std::string name;            ///< "0.1 degrees", "quartz", "no dispersion"; nulls: empty
    double facet_error_deg = 0;  ///< of Alternative::facet_error
    /// One for each key; nothing: undefined, or the picture could not be registered.
    std::vector<std::optional<double>> scores;
};

struct Calibration {
    std::vector<std::string> keys;  ///< of the scores
    std::vector<CalibrationDraw> draws;
    std::uint64_t seed = 1;
    double stone_px = 0;   ///< diameter of the stone in the compared pictures
    double psf_px = 0;     ///< sigma of the simulated photographs' blur
    double electrons = 0;  ///< at the clipping level, for their noise
    bool from_cache = false;
    std::string hash;  ///< of everything that the calibration depends on
    std::vector<std::string> notes;
};

/// To and from a cache file's text. Nothing for other text or another version.
std::string calibration_json(const Calibration& calibration);
std::optional<Calibration> calibration_from(const std::string& json);

}  // namespace culet
