#pragma once
// What a fit is asked to do.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stone/numbers/units.h"
#include "stone/solid/solid.h"

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
    /// The stone file says so. If not, beside a prior the readings decide whether meets are exact
    /// or soft (meet_evidence.h).
    bool meets_named = false;
    /// Exact meets, and the readings do not contradict them: nothing is allowed for.
    bool meets_shown = false;
    /// The stone is what its planes enclose, whichever corners that gives: so beside outlines.
    bool free_corners = false;
    /// Of soft meets, in the stone's unit; nothing: estimated from the data by variance components
    /// (Foerstner 1979): sigma^2 = sum of squared misses / their redundancy.
    std::optional<double> meet_sigma;
    /// Largest number of steps of the last stage.
    int iterations = 100;
    /// Most starts that are tried before the best of what they gave is returned; see starts.h.
    int starts = 7;
    /// Family level of both tests: the chi-square test of all readings, and (shared out among them
    /// by Bonferroni) the test of each.
    double significance = 0.001;
    Loss loss = Loss::none;
    Prior prior;
    /// Hold every reading against its tier and the mesh (first_check.h): first of all where the
    /// readings leave parts of the stone open, else where they contradict each other.
    bool first_check = false;
    /// False: the mesh is a cut design, whose size says nothing.
    bool mesh_has_size = true;
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

}  // namespace culet
