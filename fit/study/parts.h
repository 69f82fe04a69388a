#pragma once
// Private to the study: truth, draws, errors, time budget.

#include <ctime>
#include <functional>
#include <map>

#include "fit/study/study.h"

namespace culet {

inline double processor_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Tells when to stop, and reports progress.
class StudyBudget {
public:
    StudyBudget(double seconds, const Progress& progress)
        : limit_(seconds), start_(processor_seconds()), progress_(progress) {}
    bool spent() const { return limit_ > 0 && processor_seconds() - start_ > limit_; }
    /// Sets the limit: this many seconds since the start.
    void allow(double seconds) { limit_ = seconds; }
    /// `fraction` of all work. Throws Interrupted.
    void report(double fraction) const;

private:
    double limit_ = 0, start_ = 0;
    const Progress& progress_;
};

/// The truth with which fits are compared.
struct StudyTruth {
    Stone stone;                    ///< its solid is the true one
    std::vector<Reading> readings;  ///< with the values of the true stone
    struct Place {
        double inclination = 0;  ///< from up, 0 .. pi
        double azimuth = 0;      ///< from the readings' zero
        double offset = 0;       ///< distance from the middle of the stone
    };
    std::map<std::string, Place> places;  ///< by facet name
    bool azimuths_read = false;           ///< some reading fixes the zero of azimuths
    /// Offsets count from the mean of the corners, like their uncertainties; else from the centre
    /// of the volume, which does not move when meets come apart.
    bool from_corner_mean = false;
};

StudyTruth truth_of(const Stone& stone, const std::vector<Reading>& readings,
                    const FitResult& fitted, bool from_corner_mean = false);

/// The readings with a normal error each; the same for the same seed, draw and place in the list.
std::vector<Reading> drawn_readings(const std::vector<Reading>& readings, std::uint64_t seed,
                                    int draw);

/// Mean squares over the facets; level facets (table, culet) have no azimuth and do not count in
/// angles.
struct StudyError {
    double angle = 0, offset = 0;  ///< mean squares: rad2, unit2
};
StudyError mean_of(const std::vector<StudyError>& errors);
StudyError error_of(const StudyTruth& truth, const FitResult& fitted);
/// The mean squares that a fit's covariance predicts.
StudyError limit_of(const StudyTruth& truth, const FitResult& fitted);

/// Closed, with every facet, and convex where it must be.
bool is_sound(const Stone& stone, const FitResult& fitted);
/// Sound, and the search converged.
bool is_settled(const Stone& stone, const FitResult& fitted);

void study_settings(const Stone& stone, const std::vector<Reading>& readings, const FitResult& base,
                    StudyBudget& budget, Study& study);
void study_limits(const Stone& stone, const FitResult& base, const StudyTruth& truth,
                  StudyBudget& budget, Study& study);

}  // namespace culet
