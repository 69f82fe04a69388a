#pragma once
// Calibrations that were made before, in a folder.

#include <filesystem>
#include <optional>
#include <string>

#include "compare/calibration/calibration.h"
#include "compare/calibration/tilt_variance.h"

namespace culet {

struct KeptCalibration {
    Calibration calibration;
    TiltVariance tilts;  ///< what a photograph is held against for the score of the facets' tilts
};

/// A table (JSON) and a picture of numbers (PFM, one row a direction) for each hash. Whatever is
/// wrong with the folder or a file in it, the calibration is made anew.
class CalibrationCache {
public:
    /// Of an empty name nothing is kept.
    explicit CalibrationCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    std::optional<KeptCalibration> find(const std::string& hash) const;
    /// Throws InputError when the folder cannot be written.
    void keep(const Calibration& calibration, const TiltVariance& tilts) const;

private:
    std::filesystem::path file_of(const std::string& hash, const char* extension) const;

    std::filesystem::path folder_;
};

}  // namespace culet
