#pragma once
// What accuracy costs in time, and how near the fit comes to the limit of its readings.
//
// The fitted stone is the truth. Its readings are drawn anew with normal errors of their sigmas,
// and fitted again: the distance from the truth is the error to expect if the instruments are as
// good as their sigmas.

#include <cstdint>
#include <string>
#include <vector>

#include "fit/fit.h"

namespace culet {

struct StudyOptions {
    FitOptions fit;
    std::uint64_t seed = 1;
    int draws = 8;
    /// Seconds of processor time; 0: no limit. When spent, rows have fewer draws and the last may
    /// be missing; the other figures do not depend on it.
    double budget_seconds = 60;
    bool times = true;   ///< error and time of each way of fitting
    bool limits = true;  ///< error compared with the theoretical limit
};

/// One way of fitting, and its results over all draws.
struct StudySetting {
    std::string sweep;    ///< what is varied: `iterations`, `meets`, `symmetry`, `start`, `starts`
    std::string setting;  ///< "8", "soft", ... as in the stone file
    bool as_asked = false;  ///< the stone file's own setting
    int fits = 0;           ///< draws done
    int sound = 0;          ///< closed, with every facet, convex where it must be
    int settled = 0;        ///< sound, and the search converged
    /// Settled, with chi-square within max(4, 5 %) of that of the fit from the unchanged mesh.
    int best = 0;
    double angle_error = 0;  ///< root mean square over sound draws and facets, radians
    /// The same against the fit as asked of the same readings: the numerical error. Negative if the
    /// setting solves other equations.
    double angle_left = -1;
    double offset_error = 0;  ///< the same for planes' distances, in the stone's unit
    /// Processor time of one fit with its covariance: median and quartiles.
    double seconds = 0, seconds_low = 0, seconds_high = 0;
};

/// The error beside the Cramer-Rao limit: no unbiased estimate has a smaller variance than the
/// inverse of the readings' information (Rao 1945, Cramer 1946).
struct StudyLimit {
    int readings = 0;
    double share = 1;  ///< of all readings that have a value
    double dof = 0;    ///< redundancy that remains
    int draws = 0;  ///< draws done; `failed` of them found no stone and do not count in the error
    int failed = 0;
    double angle_error = 0, angle_limit = 0;    ///< radians, root mean square over facets
    double offset_error = 0, offset_limit = 0;  ///< in the stone's unit
    double ratio = 0;                           ///< angle_error / angle_limit
    double ratio_sigma = 0;  ///< standard error of the ratio, from the scatter of the draws
};

struct Study {
    FitStatus status = FitStatus::not_converged;  ///< of the fit that is taken as the truth
    std::string message;
    std::string stone;
    LengthUnit unit = LengthUnit::mm;
    int facets = 0, readings = 0;
    double seconds = 0;  ///< processor time of that fit
    std::vector<StudySetting> settings;
    std::vector<StudyLimit> limits;
    /// The limit is studied with exact meets and symmetries, because soft ones cannot be drawn
    /// anew. False: they were exact already.
    bool limit_made_exact = false;
    std::string limit_message;          ///< why `limits` ends early; may be empty
    std::vector<std::string> left_out;  ///< rows that the budget did not reach, in words
    StudyOptions options;

    bool usable() const { return status == FitStatus::converged; }
};

/// Fits the stone, then studies that fit. Throws as `fit_stone` does. If no fit is found, the study
/// is empty, with status and message.
Study study_fit(const Stone& stone, const std::vector<Reading>& readings,
                const StudyOptions& options = {}, const Progress& progress = {});

/// One JSON object (`schema` 1, `kind` "fit"), in degrees and the stone's unit.
std::string study_json(const Study& study);
/// The same rows as comma-separated values.
std::string study_time_csv(const Study& study);
std::string study_limit_csv(const Study& study);

}  // namespace culet
