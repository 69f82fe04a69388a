#pragma once
// The result of a fit: the stone, its facets and readings with uncertainties, and the findings.

#include <optional>
#include <string>
#include <vector>

#include "fit/findings/findings.h"
#include "fit/model/options.h"
#include "fit/model/undetermined.h"
#include "fit/readings/measurement.h"
#include "fit/silhouettes/silhouette.h"
#include "stone/numbers/units.h"
#include "stone/stone.h"

namespace culet {

enum class FitStatus {
    converged,
    not_converged,  ///< no stone was found, or none that could be cut
    contradictory,  ///< the readings disagree by more than their uncertainties
    undetermined    ///< parts of the stone are undetermined and stay near the mesh
};
const char* name_of(FitStatus status);

struct FittedFacet {
    std::string name;
    Plane plane;
    double inclination = 0, azimuth = 0;  ///< radians; azimuth in the frame of the fitted solid
    double inclination_own_axis = 0;      ///< NaN when the stone has no axis of its own
    double sigma_inclination = 0, sigma_azimuth = 0;  ///< radians; azimuth: NaN for level facets
    double sigma_offset = 0;  ///< of the plane's distance from the middle of the stone
    /// Part of each parameter that comes from readings instead of the prior: 1 - the variance over
    /// that of the prior alone; 1 without a prior.
    double read_inclination = 1, read_azimuth = 1, read_offset = 1;
    double area = 0;  ///< of the facet in the result; 0 if it is missing
    double sigma_area = 0;
};

/// How the outlines of one set agree with the fitted stone, in the stone's unit (silhouettes/).
struct SilhouetteFinding {
    SilhouetteMisfit misfit;
    double sigma = 0;                          ///< of a point, across the outline
    bool estimated = false;                    ///< sigma comes from the residuals
    std::optional<SilhouetteMisfit> held_out;  ///< of outlines that were not used in the fit
};

/// How far the points of a [[line]] lie from the picture of the fitted edge, in pixels.
struct LineFinding {
    double rms = 0, worst = 0;
    int points = 0;
    double u = 0, v = 0;  ///< the worst point
};

/// How a photograph of the stone in known light agrees with the fitted stone (compare/refine).
struct PhotographFinding {
    double rms_before = 0,
           rms = 0;  ///< difference of the pictures, in the root of light (white is 1)
    double parameters_determined = 0;  ///< of the planes, three a facet
    /// A place where it contradicts the fitted stone, in its pixels.
    struct Place {
        double x = 0, y = 0;
        std::string facet;  ///< the facet through which it is seen
        bool brighter = false;
        double deviations = 0, area = 0;  ///< times the usual one; part of the stone's area
    };
    std::vector<Place> contradictions;
};

struct FittedReading {
    std::string id;
    ReadingKind kind = ReadingKind::inclination;
    std::vector<std::string> of;
    double value = 0, sigma = 0, fitted = 0, residual = 0;  ///< radians, length, mm3 or carat
    double normalized = 0;  ///< residual / its own standard uncertainty (Baarda's w)
    double redundancy = 0;  ///< 0: no other reading checks it; 1: it adds nothing
    double detectable = 0;  ///< smallest error that the test would find in 80 of 100 cases; 0: none
    bool suspect = false, exact = false;
    double rounding = 0;   ///< step of the instrument; 0: none
    double weight = 1;     ///< weight that a robust loss leaves it
    std::string left_out;  ///< why it takes no part; empty if it does
    std::optional<LineFinding> line;
    std::optional<SilhouetteFinding> silhouette;
    std::optional<PhotographFinding> photograph;
};

/// How the meets of more than three facets were treated, and how far they miss.
struct MeetReport {
    int exact = 0, soft = 0, released = 0;
    double sigma = 0;                   ///< of soft meets
    double girdle_sigma = 0;            ///< of girdle facets in soft meets
    bool estimated = false;             ///< sigma comes from the data
    int local_maxima = 0;               ///< of the likelihood; the highest is taken
    double miss_rms = 0, miss_max = 0;  ///< distance of planes from their meets
};

/// The prior as it was used, in radians and the stone's unit.
struct PriorReport {
    Prior::Source source = Prior::Source::none;                                 ///< none: not used
    double tier_angle = 0, facet_angle = 0, tier_offset = 0, facet_offset = 0;  ///< estimated
};

struct SolidChecks {
    double planarity_max = 0;  ///< largest distance of a corner from one of its facets
    bool closed = false, convex = false;
    std::vector<std::string> missing_facets;  ///< of the mesh, if the planes leave no room for them
};

struct FitStatistics {
    /// With a prior: of the readings alone; one value for several facets counts once.
    double chi2 = 0, dof = 0, chi2_limit = 0, chi2_p = 1;
    double chi2_low_p = 1;     ///< chance of a chi-square this small
    double suspect_limit = 0;  ///< of |normalized|
    int rank_defect = 0;       ///< parameters of the shape that nothing determines
    MeetReport meets;
    PriorReport prior;
};

struct FitFindings {
    std::vector<std::string> suspects;  ///< ids, the worst first
    std::vector<Proposal> proposals;    ///< for the suspects
    /// Readings left out because they are far from similar ones, a line each (first_check.h).
    std::vector<std::string> doubts;
    /// An irreducible inconsistent set: the readings agree if any one of these is left out.
    std::vector<std::string> disagreeing;
    std::vector<Undetermined> undetermined;
    std::vector<std::string> undetermined_words;  ///< undetermined parameters, one sentence each
    std::vector<NextReading> help;  ///< the most useful further readings, the best first
    /// Edges to which the readings give no length, as `A/B`; the fit keeps them at almost none.
    std::vector<std::string> vanishing_edges;
    double vanishing_chi2 = 0;  ///< the chi-square that keeping them costs
    std::vector<FittedProportion> proportions;
    OwnAxis own_axis;
    std::vector<Tier> tiers;
    std::vector<NamedTierFinding> named_tiers;
    std::vector<MeetFinding> meets;
    std::vector<ShapeFinding> shapes;
    std::optional<SymmetryReport> symmetry;  ///< if asked for
};

/// `Change::what` of readings that a fit leaves out.
inline constexpr const char* k_readings_left_out = "readings left out";

struct FitLog {
    FitOptions options;  ///< as asked for; the prior as it was used
    int starts = 0;      ///< starts tried
    std::string start;   ///< the start that led to the result
    /// How the mesh was changed before the fit: turned, scaled, ...
    std::vector<std::string> notes;
    std::vector<std::string> changes;  ///< of the topology, in their order
    /// Changes to the mesh, and to the problem where the fit is better with them by the same
    /// measure.
    std::vector<Change> changed;
    int iterations = 0;
    double seconds = 0;
};

struct FitResult {
    FitStatus status = FitStatus::not_converged;
    std::string message;  ///< why, in one line
    Solid solid;          ///< in `unit`
    LengthUnit unit = LengthUnit::mm;
    double azimuth_zero = 0;  ///< direction in the solid's frame from which the readings' azimuths
                              ///< count; radians
    SolidChecks checks;
    std::vector<FittedFacet> facets;  ///< in the mesh's order
    /// Covariance of the facets' inclinations, azimuths (radians) and offsets (`unit`), row-major,
    /// three rows a facet. Empty if unknown or with more than 300 facets.
    std::vector<double> facet_covariance;
    std::vector<FittedReading> readings;  ///< in their order
    FitStatistics statistics;
    FitFindings findings;
    FitLog log;

    bool usable() const { return status == FitStatus::converged; }
};

}  // namespace culet
