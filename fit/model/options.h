#pragma once
// Options of a fit.

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

/// How outlying readings count: as in least squares, or less (robust.h).
enum class Loss { none, huber, cauchy };
const char* name_of(Loss loss);

/// The prior of the facets: they lie near those of the start within these standard uncertainties,
/// and the facets of a tier are alike (prior.h). It determines what the readings do not.
struct Prior {
    /// What the start is: the design that the stone was cut to, or a drawing of the stone itself.
    enum class Source { none, catalogue, mesh } source = Source::none;
    /// False: only where the readings leave parts of the stone undetermined.
    bool always = false;
    double inclination_sigma = radians(1), azimuth_sigma = radians(1);
    double offset_sigma = 0.01;  ///< of a plane's distance from the middle, as a part of the width
};
const char* name_of(Prior::Source source);

struct FitOptions {
    /// For meets of more than three facets without a `meet` reading.
    MeetTreatment meets = MeetTreatment::exact;
    /// The stone file names `meets`. Otherwise, beside a prior, the readings decide whether meets
    /// are exact or soft (meet_evidence.h).
    bool meets_named = false;
    /// Exact meets that the readings support: no allowance for what real meets miss.
    bool exact_meets_supported = false;
    /// The stone is what its planes enclose, whatever its corners; used with outlines.
    bool free_corners = false;
    /// Sigma of soft meets, in the stone's unit. Nothing: estimated from the data as a variance
    /// component (Foerstner 1979): sigma^2 = sum of squared misses / their redundancy.
    std::optional<double> meet_sigma;
    /// Most steps of the last stage.
    int iterations = 100;
    /// Most starts tried (starts.h).
    int starts = 7;
    /// Family-wise level of both tests: the chi-square test of all readings, and the test of each
    /// reading (Bonferroni).
    double significance = 0.001;
    Loss loss = Loss::none;
    Prior prior;
    /// Compare every reading with its tier and the mesh (first_check.h): at first where the
    /// readings leave parts of the stone undetermined, otherwise where they contradict each other.
    bool first_check = false;
    /// False: the mesh is a cut design without a size.
    bool mesh_has_size = true;
    /// An earlier result of the same mesh and nearly the same readings. The fit continues from it,
    /// and tries other starts only if that fails.
    std::optional<Solid> start;
    /// Examine the stone's own axis, contradicted meets, and edges and facets that the readings
    /// leave undetermined or contradict.
    bool findings = true;
    bool find_symmetry = false;
    /// Edges and facets that the readings contradict may change or disappear, and contradicted
    /// meets may come apart.
    bool allow_topology = false;
};

/// Reads the [fit] table of a stone file: `meets` = "exact" | "soft" | "released", `meet_sigma`,
/// `iterations`, `starts`, `significance`, `loss` = "none" | "huber" | "cauchy", `prior` =
/// "catalogue" | "mesh" | "none". The default prior is the catalogue's for a mesh that `culet cut`
/// wrote and for GemCad designs, else the mesh's; it counts only where readings leave the stone
/// undetermined. `first_check` is on. Throws InputError.
FitOptions read_fit_options(const std::filesystem::path& stone_file,
                            const std::vector<std::string>& overrides = {});

}  // namespace culet
