#pragma once
// What a fit comes to: the stone, what is known of each facet and reading, and what was found out.

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
    not_converged,  ///< no stone was found, or not one that could be cut
    contradictory,  ///< the readings do not agree within their uncertainties
    undetermined    ///< parts of the stone are open: nearly as in the mesh
};
const char* name_of(FitStatus status);

struct FittedFacet {
    std::string name;
    Plane plane;
    double inclination = 0, azimuth = 0;  ///< radians; azimuth in the frame of the fitted solid
    double inclination_own_axis = 0;      ///< NaN when the stone has no axis of its own
    double sigma_inclination = 0, sigma_azimuth = 0;  ///< radians; azimuth: NaN for level facets
    double sigma_offset = 0;  ///< of the plane's distance from the middle of the stone
    /// What part the readings have in these, the rest being the prior's: 1 - the variance over that
    /// of the prior alone. 1 without a prior.
    double read_inclination = 1, read_azimuth = 1, read_offset = 1;
    double area = 0;  ///< of the facet in the result; 0: not there
    double sigma_area = 0;
};

/// How the outlines of one set lie to the fitted stone, in the stone's unit (silhouettes/).
struct SilhouetteFinding {
    SilhouetteMisfit misfit;
    double sigma = 0;                          ///< across the outline
    bool estimated = false;                    ///< from the residuals
    std::optional<SilhouetteMisfit> held_out;  ///< of outlines that took no part
};

/// How a photograph of the stone in known light suits the fitted stone (compare/refine).
struct PhotographFinding {
    double rms_before = 0, rms = 0;  ///< of the two pictures' difference in the root of light
    double moves_told = 0;           ///< of the planes' moves, three a facet, how many it tells
    /// Where it shows what the stone does not, in its pixels.
    struct Place {
        double x = 0, y = 0;
        std::string facet;  ///< through which it is seen
        bool brighter = false;
        double deviations = 0, area = 0;  ///< over what is usual; as a share of the stone
    };
    std::vector<Place> contradictions;
};

struct FittedReading {
    std::string id;
    ReadingKind kind = ReadingKind::inclination;
    std::vector<std::string> of;
    double value = 0, sigma = 0, fitted = 0, residual = 0;  ///< radians, length, mm3 or carat
    double normalized = 0;  ///< residual / its own standard uncertainty (Baarda's w)
    double redundancy = 0;  ///< 0: nothing checks this reading; 1: it adds nothing
    double detectable = 0;  ///< smallest error that the test would find, 80 times in 100; 0: none
    bool suspect = false, exact = false;
    double rounding = 0;   ///< step of the instrument; 0: none
    double weight = 1;     ///< left to it by a robust loss
    std::string left_out;  ///< why it takes no part; empty: it does
    std::optional<SilhouetteFinding> silhouette;
    std::optional<PhotographFinding> photograph;
};

/// How the meets of more than three facets were treated, and by how much they miss.
struct MeetReport {
    int exact = 0, soft = 0, released = 0;
    double sigma = 0;         ///< of soft meets
    double girdle_sigma = 0;  ///< of girdle facets in soft meets
    bool estimated = false;   ///< sigma comes from the data
    int ends = 0;  ///< of the estimate: how many local ones were found; the likeliest is taken
    double miss_rms = 0, miss_max = 0;  ///< distance of planes from their meets
};

/// The prior as it was used, in radians and the stone's unit.
struct PriorReport {
    Prior::Source source = Prior::Source::none;                                 ///< none: not used
    double tier_angle = 0, facet_angle = 0, tier_offset = 0, facet_offset = 0;  ///< estimated
};

/// What the fitted solid is, held against what a stone must be.
struct SolidChecks {
    double planarity_max = 0;  ///< a corner's largest distance from a facet of its own
    bool closed = false, convex = false;
    std::vector<std::string> missing_facets;  ///< of the mesh, that the planes leave no room for
};

/// How well the readings agree, all together.
struct FitStatistics {
    /// Beside a prior of the readings alone, one value for several facets counting once.
    double chi2 = 0, dof = 0, chi2_limit = 0, chi2_p = 1;
    double chi2_low_p = 1;     ///< chance of a chi-square as small
    double suspect_limit = 0;  ///< of |normalized|
    int rank_defect = 0;       ///< parameters of the shape that nothing fixes
    MeetReport meets;
    PriorReport prior;
};

/// What was found out about the readings and the stone.
struct FitFindings {
    std::vector<std::string> suspects;  ///< ids, the worst first
    std::vector<Proposal> proposals;    ///< for the suspects
    /// Readings left out because they are far off what their like say, a line each (first_check.h).
    std::vector<std::string> doubts;
    /// Readings that cannot hold together, though without any one of them the others can.
    std::vector<std::string> disagreeing;
    std::vector<Undetermined> undetermined;
    std::vector<std::string> undetermined_words;  ///< what nothing fixes, one sentence each
    std::vector<NextReading> help;                ///< the best further readings, the best first
    /// Edges that the readings want to have no length, as `A/B`: they are kept at a hair's.
    std::vector<std::string> vanishing_edges;
    double vanishing_chi2 = 0;  ///< what keeping them costs
    std::vector<FittedProportion> proportions;
    OwnAxis own_axis;
    std::vector<Tier> tiers;
    std::vector<NamedTierFinding> named_tiers;
    std::vector<MeetFinding> meets;
    std::vector<ShapeFinding> shapes;
    std::optional<SymmetryReport> symmetry;  ///< when it was looked for
};

/// Change::what of readings that a fit does without.
inline constexpr const char* k_readings_left_out = "readings left out";

/// How the result came about.
struct FitLog {
    FitOptions options;  ///< as asked for; the prior as it was used
    int starts = 0;      ///< tried
    std::string start;   ///< that the result came from
    /// What was done to the mesh before it could be fitted: turned round, scaled, ...
    std::vector<std::string> notes;
    std::vector<std::string> changes;  ///< of the topology, in their order
    /// What was changed against what was given: of the mesh, and of the problem where the fit is
    /// better so by the same measure.
    std::vector<Change> changed;
    int iterations = 0;
    double seconds = 0;
};

struct FitResult {
    FitStatus status = FitStatus::not_converged;
    std::string message;  ///< why, in one line
    Solid solid;          ///< in `unit`
    LengthUnit unit = LengthUnit::mm;
    double azimuth_zero = 0;  ///< where in the solid's frame the readings' azimuths begin; radians
    SolidChecks checks;
    std::vector<FittedFacet> facets;  ///< in the mesh's order
    /// Covariance of the facets' inclinations, azimuths (radians) and offsets (`unit`), row by row,
    /// three a facet in the order of `facets`. Empty: not known, or of more than 300 facets.
    std::vector<double> facet_covariance;
    std::vector<FittedReading> readings;  ///< in their order
    FitStatistics statistics;
    FitFindings findings;
    FitLog log;

    /// Good enough to go on with.
    bool usable() const { return status == FitStatus::converged; }
};

}  // namespace culet
