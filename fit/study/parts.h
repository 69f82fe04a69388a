#pragma once
// Private to the study: truth, draws, errors, budget.

#include <ctime>
#include <functional>
#include <map>

#include "fit/study/study.h"

namespace culet {

/// Processor time of this process, seconds.
inline double processor_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Says when to stop, and how far the work is.
class StudyBudget {
public:
    StudyBudget(double seconds, const Progress& progress)
        : limit_(seconds), start_(processor_seconds()), progress_(progress) {}
    bool spent() const { return limit_ > 0 && processor_seconds() - start_ > limit_; }
    /// From now on up to this many seconds in all.
    void allow(double seconds) { limit_ = seconds; }
    /// `fraction` of all work. Throws Interrupted.
    void report(double fraction) const;

private:
    double limit_ = 0, start_ = 0;
    const Progress& progress_;
};

/// What a fit is held against.
struct StudyTruth {
    Stone stone;                    ///< its solid is the true one
    std::vector<Reading> readings;  ///< with the values that the true stone gives
    struct Place {
        double inclination = 0;  ///< from above, 0 .. pi
        double azimuth = 0;      ///< from the zero of the readings
        double offset = 0;       ///< distance from the middle of the stone
    };
    std::map<std::string, Place> places;  ///< by facet
    bool azimuths_read = false;           ///< some reading fixes where azimuths begin
    /// Offsets count from the mean of the corners, as uncertainties of offsets do; else from the
    /// middle of the volume, which stays where it is when meets come apart.
    bool from_corner_mean = false;
};

StudyTruth truth_of(const Stone& stone, const std::vector<Reading>& readings,
                    const FitResult& fitted, bool from_corner_mean = false);

/// The readings with a normal error each, the same for the same seed, draw and place in the list.
std::vector<Reading> drawn_readings(const std::vector<Reading>& readings, std::uint64_t seed,
                                    int draw);

/// Mean squares over the facets. Facets that level (table, culet) have no azimuth and are left out
/// of angles.
struct StudyError {
    double angle = 0, offset = 0;  ///< mean squares: rad2, unit2
};
StudyError mean_of(const std::vector<StudyError>& errors);
StudyError error_of(const StudyTruth& truth, const FitResult& fitted);
/// What the covariance of a fit says those mean squares should be.
StudyError limit_of(const StudyTruth& truth, const FitResult& fitted);

/// Closed, every facet there, convex where it must be.
bool is_sound(const Stone& stone, const FitResult& fitted);
/// Sound, and the search ended by itself.
bool is_settled(const Stone& stone, const FitResult& fitted);

void study_settings(const Stone& stone, const std::vector<Reading>& readings, const FitResult& base,
                    StudyBudget& budget, Study& study);
void study_limits(const Stone& stone, const FitResult& base, const StudyTruth& truth,
                  StudyBudget& budget, Study& study);

}  // namespace culet
