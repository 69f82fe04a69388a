#include "fit/model/fit_model.h"

#include <algorithm>

#include "fit/model/constants.h"
#include "fit/readings/replicates.h"
#include "fit/readings/rounding.h"

namespace culet {

namespace {

Shape shape_of(const Frame& frame) {
    Shape shape;
    shape.points = frame.solid().vertices;
    for (const Facet& facet : frame.solid().facets) {
        shape.normals.push_back(facet.plane.normal);
        shape.offsets.push_back(facet.plane.offset);
    }
    if (frame.up_facet() >= 0) shape.normals[frame.up_facet()] = Vec3{0, 0, 1};
    return shape;
}

std::shared_ptr<const Outline> outline_of_mesh(const Solid& solid) {
    auto outline = std::make_shared<Outline>();
    for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
        outline->corners.push_back({static_cast<int>(v), {-1, -1, -1}});
    }
    for (const Facet& facet : solid.facets) outline->loops.push_back(facet.corners);
    return outline;
}

}  // namespace

FitModel::FitModel(const Stone& stone, const std::vector<Reading>& readings,
                   const FitOptions& options)
    : stone_(stone),
      frame_(stone, readings),
      edges_(half_edges(frame_.solid())),
      mesh_shape_(shape_of(frame_)),
      mesh_outline_(outline_of_mesh(frame_.solid())),
      readings_(readings),
      meets_(list_meets(frame_, edges_, readings, options, mesh_shape_)),
      known_planes_(list_known_planes(frame_, readings, !stone.azimuth_from_mesh)),
      symmetries_(stone, frame_, readings, meets_.splits, mesh_shape_),
      lines_(frame_, readings, mesh_shape_),
      has_outlines_(std::any_of(readings.begin(), readings.end(), [](const Reading& r) {
          return r.outline_observations != nullptr;
      })) {
    const Solid& solid = frame_.solid();
    if (options.prior.source != Prior::Source::none) {
        prior_ =
            make_prior(options.prior, solid, frame_.up_facet(), frame_.half_width(), mesh_shape_);
        estimate_angle_sigmas(solid, readings_, prior_);
        const bool exact = options.meets == MeetTreatment::exact && !options.exact_meets_supported;
        count_beside_prior(
            mesh_shape_, solid, exact ? k_prior.meet_miss * 2 * frame_.half_width() : 0,
            [&](const Reading& r) { return frame_.unit_of(r); }, readings_);
    }
    std::vector<std::pair<int, int>> alike;
    for (std::size_t r = 0; r < readings_.size(); ++r) {
        const auto& pairs = symmetries_.pairs(r);
        if (readings_[r].exact) alike.insert(alike.end(), pairs.begin(), pairs.end());
    }
    widen_for_rounding(readings_, alike, int(solid.facets.size()));
    replicated_ = repeated_readings(readings_);
}

}  // namespace culet
