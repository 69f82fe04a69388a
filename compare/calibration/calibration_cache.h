#pragma once
// A folder of calibrations made earlier.

#include <filesystem>
#include <optional>
#include <string>

#include "compare/calibration/calibration.h"
#include "compare/calibration/tilt_variance.h"

namespace culet {

struct KeptCalibration {
    Calibration calibration;
    TiltVariance tilts;  ///< for the score of the facets' tilts
};

/// One table (JSON) and one picture of numbers (PFM, a row for each direction) for each hash.
/// Unusable files are ignored, and the calibration is made anew.
class CalibrationCache {
public:
    /// With an empty name nothing is kept.
    explicit CalibrationCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    std::optional<KeptCalibration> find(const std::string& hash) const;
    /// Throws InputError when the folder cannot be written.
    void keep(const Calibration& calibration, const TiltVariance& tilts) const;

private:
    std::filesystem::path file_of(const std::string& hash, const char* extension) const;

    std::filesystem::path folder_;
};

}  // namespace culet
