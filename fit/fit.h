#pragma once
// Front door of the room: which stone explains the measurements.
//
// The mesh gives the facets, which of them meet where, and a start; the readings move it. Facet
// planes and meets are fitted together by least squares, each reading weighted by 1/sigma^2, under
// hard constraints: every facet is planar, exact readings hold exactly, and so do the meets of the
// mesh unless they are told to be soft or released.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fit/assessment.h"
#include "fit/findings.h"
#include "fit/measurement.h"
#include "stone/progress.h"
#include "stone/stone.h"
#include "stone/units.h"

namespace culet {

enum class MeetTreatment {
    exact,    ///< all planes of a meet pass through one point
    soft,     ///< each plane of a meet passes the common point within a standard uncertainty
    released  ///< meets of more than three planes come apart freely
};
const char* name_of(MeetTreatment treatment);

/// How readings that are far off count: as least squares has it, or less (see robust.h).
enum class Loss { none, huber, cauchy };
const char* name_of(Loss loss);

/// What is supposed of the facets before any reading: they lie near those of the start, within
/// these standard uncertainties, and the facets of a tier are alike (prior.h). It fills what the
/// readings leave open.
struct Prior {
    /// What the start is: the design that the stone was cut by, or a drawing of the stone itself.
    enum class Source { none, catalogue, mesh } source = Source::none;
    /// False: only where the readings leave parts of the stone open.
    bool always = false;
    double inclination_sigma = radians(1), azimuth_sigma = radians(1);
    double offset_sigma = 0.01;  ///< of a plane's distance from the middle, as part of the width
};
const char* name_of(Prior::Source source);

struct FitOptions {
    /// Of meets of more than three facets that no `meet` reading speaks of.
    MeetTreatment meets = MeetTreatment::exact;
    /// Of soft meets, in the stone's unit; nothing: estimated from the data by variance components
    /// (Foerstner 1979): sigma^2 = sum of squared misses / their redundancy.
    std::optional<double> meet_sigma;
    /// Largest number of steps of the last stage.
    int iterations = 100;
    /// Most starts that are tried before the best of what they gave is returned; see starts.h.
    int starts = 13;
    /// Family level of both tests: the chi-square test of all readings, and (shared out among them
    /// by Bonferroni) the test of each.
    double significance = 0.001;
    Loss loss = Loss::none;
    Prior prior;
    /// Hold every reading against its tier and the mesh first (first_check.h), where the readings
    /// do not check each other: they leave parts of the stone open.
    bool first_check = false;
    /// An earlier result of the same mesh and nearly the same readings: the fit goes on from there
    /// and looks for no other start, unless it cannot get there.
    std::optional<Solid> start;
    /// Find out about the stone's own axis, contradicted meets, and edges and facets that the
    /// readings leave open or deny.
    bool findings = true;
    /// Propose the stone's symmetry.
    bool find_symmetry = false;
    /// Edges and facets that the readings deny may change or go, contradicted meets come apart.
    bool allow_topology = false;
};

/// The [fit] table of a stone file: `meets` = "exact" | "soft" | "released", `meet_sigma`,
/// `iterations`, `starts`, `significance`, `loss` = "none" | "huber" | "cauchy", `prior` =
/// "catalogue" | "mesh" | "none". Where no prior is named it is the catalogue's for a mesh that
/// `culet cut` wrote and for GemCad designs, else the mesh's, and counts only where readings leave
/// the stone open. `first_check` is on. Throws InputError.
FitOptions read_fit_options(const std::filesystem::path& stone_file,
                            const std::vector<std::string>& overrides = {});

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
    double area = 0;          ///< of the facet in the result; 0: not there
    double sigma_area = 0;
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
};

struct Undetermined {
    std::string facet;
    std::string freedom;  ///< `inclination`, `azimuth` or `offset`
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
    Prior::Source source = Prior::Source::none;  ///< none: not used
    double tier_angle = 0, facet_angle = 0, tier_offset = 0, facet_offset = 0;  ///< estimated
};

struct FitResult {
    FitStatus status = FitStatus::not_converged;
    std::string message;  ///< why, in one line
    Solid solid;          ///< in the stone's unit
    LengthUnit unit = LengthUnit::mm;
    std::vector<FittedFacet> facets;  ///< in the mesh's order
    std::vector<FittedReading> readings;
    std::vector<Undetermined> undetermined;
    std::vector<std::string> suspects;  ///< ids, the worst first
    std::vector<Proposal> proposals;    ///< for the suspects
    /// Readings left out because they are far off what their like say, a line each (first_check.h).
    std::vector<std::string> doubts;
    /// The smallest set of readings that cannot hold together, where there is a contradiction.
    std::vector<std::string> disagreeing;
    std::vector<std::string> undetermined_words;  ///< what nothing fixes, one sentence each
    std::vector<NextReading> help;                ///< the best further readings, the best first
    std::vector<FittedProportion> proportions;
    std::vector<std::string> missing_facets;
    /// Edges that the readings want to have no length, as `A/B`: they are kept at a hair's.
    std::vector<std::string> vanishing_edges;
    double vanishing_chi2 = 0;  ///< what keeping them costs
    int starts = 0;             ///< tried
    std::string start;          ///< that the result came from
    /// What was done to the mesh before it could be fitted: turned round, scaled, ...
    std::vector<std::string> notes;
    MeetReport meets;
    PriorReport prior;
    OwnAxis own_axis;
    std::vector<Tier> tiers;
    std::vector<NamedTierFinding> named_tiers;
    std::vector<MeetFinding> meet_findings;
    std::vector<ShapeFinding> shape_findings;
    std::vector<ExtraFacet> extra_facets;
    std::optional<SymmetryReport> symmetry;  ///< when it was looked for
    std::vector<std::string> changes;        ///< of the topology, in their order
    double planarity_max = 0;
    bool closed = false, convex = false;
    double chi2 = 0, dof = 0, chi2_limit = 0, chi2_p = 1;
    double suspect_limit = 0;  ///< of |normalized|
    double azimuth_zero = 0;   ///< where in the solid's frame the readings' azimuths begin; radians
    int undetermined_freedoms = 0;
    int iterations = 0;
    double seconds = 0;
    FitOptions options;

    /// Good enough to go on with.
    bool usable() const { return status == FitStatus::converged; }
};

/// Fits the stone to its readings. The result keeps the mesh's facet names and its pose, but for
/// one turn: an up direction within 20 degrees of a coordinate axis comes to lie on it exactly.
/// Throws InputError when the mesh is not a closed solid or a relation cannot be found on it.
FitResult fit_stone(const Stone& stone, const std::vector<Reading>& readings,
                    const FitOptions& options = {}, const Progress& progress = {});

/// One JSON object, degrees and the stone's unit (`schema` 1).
std::string fit_report(const FitResult& result);

}  // namespace culet
