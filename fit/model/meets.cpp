#include "fit/model/meets.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "fit/model/constants.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// The mesh's point at which all these facets meet, or -1.
int meeting_point(const HalfEdges& edges, const std::set<int>& wanted) {
    for (std::size_t v = 0; v < edges.facets_of_vertex.size(); ++v) {
        const std::vector<int>& facets = edges.facets_of_vertex[v];
        const auto held =
            std::count_if(facets.begin(), facets.end(), [&](int f) { return wanted.count(f) > 0; });
        if (held == static_cast<std::ptrdiff_t>(wanted.size())) return static_cast<int>(v);
    }
    return -1;
}

// Appends a meet that the mesh does not have as a point near the facets' corners.
int added_point(const Solid& solid, const Reading& reading, Shape& shape) {
    Vec3 start(0);
    for (int f : reading.facets) {
        start += corner_mean(solid, solid.facets[f]) / static_cast<double>(reading.facets.size());
    }
    shape.points.push_back(start);
    return static_cast<int>(shape.points.size()) - 1;
}

}  // namespace

Meets list_meets(const Frame& frame, const HalfEdges& edges, const std::vector<Reading>& readings,
                 const FitOptions& options, Shape& shape) {
    Meets meets;
    std::vector<Incidence>& all = meets.incidences;
    // The start of an estimate does not affect its result.
    meets.group_sigmas.fill(options.meet_sigma ? *options.meet_sigma / frame.scale() : 0.01);
    meets.estimates_sigmas = !options.meet_sigma;
    const auto add = [&](int point, int facet, MeetTreatment how, double sigma, int reading) {
        all.push_back({point, facet, how, sigma, reading, frame.is_girdle(facet)});
    };
    for (std::size_t v = 0; v < edges.facets_of_vertex.size(); ++v) {
        const std::vector<int>& facets = edges.facets_of_vertex[v];
        // Three planes always meet.
        const MeetTreatment how = facets.size() > 3 ? options.meets : MeetTreatment::exact;
        for (int f : facets) add(static_cast<int>(v), f, how, 0, -1);
    }
    for (std::size_t r = 0; r < readings.size(); ++r) {
        const Reading& reading = readings[r];
        if (reading.kind != ReadingKind::meet) continue;
        const std::set<int> wanted(reading.facets.begin(), reading.facets.end());
        const MeetTreatment how = reading.released ? MeetTreatment::released
                                  : reading.exact  ? MeetTreatment::exact
                                                   : MeetTreatment::soft;
        const double sigma = reading.sigma / frame.scale();
        const int point = meeting_point(edges, wanted);
        if (point < 0) {
            if (reading.released) {
                throw InputError(
                    reading.file, reading.line,
                    fmt::format("meet '{}': these facets do not meet in the mesh, so there "
                                "is nothing to release",
                                reading.id));
            }
            const int added = added_point(frame.solid(), reading, shape);
            for (int f : reading.facets) add(added, f, how, sigma, static_cast<int>(r));
            continue;
        }
        if (edges.facets_of_vertex[point].size() == 3) continue;
        for (Incidence& incidence : all) {
            if (incidence.point != point || wanted.count(incidence.facet) == 0) continue;
            incidence.how = how;
            incidence.sigma = sigma;
            incidence.reading = static_cast<int>(r);
        }
    }
    meets.splits = options.free_corners || std::any_of(all.begin(), all.end(), [](const auto& i) {
                       return i.how != MeetTreatment::exact;
                   });
    return meets;
}

bool Meets::has_common() const {
    return std::any_of(incidences.begin(), incidences.end(),
                       [](const Incidence& i) { return i.has_common_sigma(); });
}

double Meets::sigma(const Incidence& incidence) const {
    return incidence.how == MeetTreatment::exact      ? 0
           : incidence.how == MeetTreatment::released ? k_shapes.released_sigma
           : incidence.sigma > 0                      ? incidence.sigma
                                                      : group_sigmas[std::size_t(incidence.group)];
}

}  // namespace culet
