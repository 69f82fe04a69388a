#pragma once
// The meets of a stone: which planes pass through which points, and how precisely.

#include <array>
#include <vector>

#include "fit/model/frame.h"
#include "fit/model/options.h"
#include "stone/solid/half_edges.h"

namespace culet {

struct Incidence {
    int point = -1, facet = -1;
    MeetTreatment how = MeetTreatment::exact;
    double sigma = 0;  ///< of a soft one; 0: the common sigma of its group
    int reading = -1;  ///< that asks for it
    int group = 0;     ///< 0: polished facets; 1: girdle facets, which are shaped by other means

    bool has_common_sigma() const { return how == MeetTreatment::soft && sigma == 0; }
};

struct Meets {
    std::vector<Incidence> incidences;
    /// Sigma of soft meets without a sigma of their own, by group.
    std::array<double, 2> group_sigmas{};
    /// The stone file gives no uncertainty of soft meets.
    bool estimates_sigmas = false;
    /// Some meet may come apart: the stone is the solid that its planes enclose.
    bool splits = false;

    bool has_common() const;
    bool has_estimated_groups() const { return estimates_sigmas && has_common(); }
    /// By how much a plane may miss its meet; 0 when exact.
    double sigma(const Incidence& incidence) const;
};

/// Lists the meets of the mesh and of `meet` readings. A meet that only a reading names is appended
/// to the points of `shape`. Throws InputError.
Meets list_meets(const Frame& frame, const HalfEdges& edges, const std::vector<Reading>& readings,
                 const FitOptions& options, Shape& shape);

}  // namespace culet
