#include "fit/model/system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <set>

#include "fit/model/azimuth_turn.h"
#include "fit/model/canonical.h"
#include "fit/model/constants.h"
#include "fit/readings/rounding.h"
#include "stone/checks.h"
#include "stone/errors.h"
#include "stone/upper_median.h"
#include "stone/upright.h"

namespace culet {

System::System(const Stone& stone, const std::vector<Reading>& readings, const FitOptions& options)
    : stone_(stone), readings_(readings), solid_(stone.solid) {
    if (solid_.facets.size() < 4) throw InputError("the mesh has fewer than four facets");
    if (!is_closed(solid_)) {
        const std::vector<Fault> faults = find_faults(solid_, {.planarity = 1e300});
        throw InputError("the mesh is not a closed solid" +
                         (faults.empty() ? std::string() : ": " + faults.front().what) +
                         "; `culet info` lists its faults");
    }
    edges_ = half_edges(solid_);
    if (!(volume(solid_) > 0) && (!stone.convex || lies_mirrored(solid_, edges_))) {
        throw InputError(
            "the mesh is inside out: its facets run clockwise seen from outside; turn them round");
    }
    bring_upright();
    list_incidences(options);
    list_known_planes();
    add_extras();
    if (options.prior.source != Prior::Source::none) {
        prior_ = make_prior(options.prior, solid_, up_facet_, half_width(), mesh_shape_);
        estimate_angle_sigmas(solid_, readings_, prior_);
        const bool exact = options.meets == MeetTreatment::exact && !options.meets_shown;
        count_beside_prior(
            mesh_shape_, solid_, exact ? k_prior.meet_miss * 2 * half_width() : 0,
            [&](const Reading& r) { return unit_of(r); }, readings_);
    }
    find_exchanges();
    pair_facets();
    list_exact_motions();
    std::vector<std::pair<int, int>> alike;
    for (std::size_t r = 0; r < readings_.size(); ++r) {
        if (readings_[r].exact) alike.insert(alike.end(), pairs_[r].begin(), pairs_[r].end());
    }
    widen_for_rounding(readings_, alike, int(solid_.facets.size()));
    replicated_ = repeated_readings(readings_);
}

double System::scale_of_readings(const Vec3& up) const {
    // Outlines have given the mesh its size.
    if (std::any_of(readings_.begin(), readings_.end(),
                    [](const Reading& r) { return r.told != nullptr; })) {
        return 1;
    }
    // In logarithms, read over drawn: of the overall lengths, then of single edges too.
    std::vector<double> logs;
    for (const Reading& r : readings_) {
        double mine = 0;
        if (r.kind == ReadingKind::depth) {
            mine = width_along(solid_, up);
        } else if (r.kind == ReadingKind::width) {
            const Vec3 direction =
                r.has_direction ? r.direction
                                : Vec3{std::cos(r.azimuth), std::sin(r.azimuth), 0} * upright_;
            mine = width_along(solid_, direction);
        }
        if (mine > 0 && r.value > 0) logs.push_back(std::log(r.value / mine));
    }
    const auto [least, most] = std::minmax_element(logs.begin(), logs.end());
    // Within the errors of a drawing.
    const double drawn = std::log(3.0);
    const bool any_overall = !logs.empty();
    if (any_overall && *most - *least < drawn) {
        return std::exp(std::accumulate(logs.begin(), logs.end(), 0.0) / double(logs.size()));
    }
    // A needle whose table is drawn askew is as wide as it is long: there, and where nothing
    // overall was read, the middle one of what single lengths say.
    for (const Reading& r : readings_) {
        if (r.kind != ReadingKind::edge || r.facets.size() != 2 || !(r.value > 0)) continue;
        for (const Edge& e : edges_.edges) {
            if (std::minmax(e.left, e.right) != std::minmax(r.facets[0], r.facets[1])) continue;
            const double mine = glm::length(solid_.vertices[e.from] - solid_.vertices[e.to]);
            if (mine > 0) logs.push_back(std::log(r.value / mine));
            break;
        }
    }
    if (logs.empty()) return 1;
    const double middle = upper_median(logs);
    // The mesh's own size is as good as edges that differ no more than drawings do.
    return !any_overall && std::abs(middle) < drawn ? 1 : std::exp(middle);
}

void System::bring_upright() {
    Vec3 mean(0);
    for (const Vec3& v : solid_.vertices) mean += v / static_cast<double>(solid_.vertices.size());
    middle_ = mean;

    up_facet_ = stone_.up_facet.empty() ? -1 : find_facet(solid_, stone_.up_facet);
    if (!stone_.up_facet.empty() && up_facet_ < 0) {
        throw InputError(fmt::format("`up` of [stone] names the facet '{}', which the mesh has not",
                                     stone_.up_facet));
    }
    const auto plane_of = [&](const Facet& facet) {
        std::vector<Vec3> loop;
        for (int corner : facet.corners) loop.push_back(solid_.vertices[corner]);
        return plane_through(loop);
    };
    const Vec3 up =
        up_facet_ >= 0 ? plane_of(solid_.facets[up_facet_]).normal : glm::normalize(stone_.up);
    upright_ = turn_upright(up);
    Vec3 out_up = up;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(up[axis]) < std::cos(radians(k_frame.snap_deg))) continue;
        out_up = Vec3(0);
        out_up[axis] = up[axis] > 0 ? 1 : -1;
    }
    outward_ = turn_upright(out_up);

    mesh_scale_ = scale_of_readings(up);
    scale_ = 0.5 * diameter(solid_) * mesh_scale_;
    check(scale_ > 0 && std::isfinite(scale_), "a solid without size");

    const auto inside = [&](const Vec3& p) {
        return upright_ * (p - middle_) * (mesh_scale_ / scale_);
    };
    for (Vec3& v : solid_.vertices) v = inside(v);
    for (Facet& facet : solid_.facets) facet.plane = plane_of(facet);

    // Where the readings' azimuths begin on the mesh: the mean direction of their differences.
    turn_ = azimuth_turn(
        readings_, [&](int facet) { return solid_.facets[facet].plane.normal; },
        stone_.azimuth_from_mesh);
    const glm::dmat3 turn = turn_about_z(turn_);
    for (Vec3& v : solid_.vertices) v = turn * v;
    mesh_shape_.points = solid_.vertices;
    auto outline = std::make_shared<Outline>();
    for (std::size_t v = 0; v < solid_.vertices.size(); ++v) {
        outline->corners.push_back({static_cast<int>(v), {-1, -1, -1}});
    }
    for (Facet& facet : solid_.facets) {
        facet.plane = plane_of(facet);
        // A rough mesh may have facets that look inwards; the middle is inside any convex stone.
        const Vec3 away = corner_mean(solid_, facet);
        if (stone_.convex && glm::dot(facet.plane.normal, away) < 0) {
            facet.plane.normal = glm::normalize(away);
            facet.plane.offset = glm::length(away);
        }
        mesh_shape_.normals.push_back(facet.plane.normal);
        mesh_shape_.offsets.push_back(facet.plane.offset);
        outline->loops.push_back(facet.corners);
    }
    if (up_facet_ >= 0) mesh_shape_.normals[up_facet_] = Vec3{0, 0, 1};
    mesh_outline_ = outline;
}

void System::list_incidences(const FitOptions& options) {
    // Where an estimate starts is of no matter for where it ends.
    group_sigmas_.fill(options.meet_sigma ? *options.meet_sigma / scale_ : 0.01);
    estimates_meets_ = !options.meet_sigma;
    for (std::size_t v = 0; v < edges_.facets_of_vertex.size(); ++v) {
        const std::vector<int>& facets = edges_.facets_of_vertex[v];
        for (int f : facets) {
            Incidence incidence{static_cast<int>(v), f, MeetTreatment::exact, 0, -1};
            if (facets.size() > 3) incidence.how = options.meets;
            incidences_.push_back(incidence);
        }
    }
    for (std::size_t r = 0; r < readings_.size(); ++r) {
        const Reading& reading = readings_[r];
        if (reading.kind != ReadingKind::meet) continue;
        const std::set<int> wanted(reading.facets.begin(), reading.facets.end());
        int point = -1;
        for (std::size_t v = 0; v < edges_.facets_of_vertex.size() && point < 0; ++v) {
            const std::vector<int>& facets = edges_.facets_of_vertex[v];
            const auto held = std::count_if(facets.begin(), facets.end(),
                                            [&](int f) { return wanted.count(f) > 0; });
            if (held == static_cast<std::ptrdiff_t>(wanted.size())) point = static_cast<int>(v);
        }
        const MeetTreatment how = reading.released ? MeetTreatment::released
                                  : reading.exact  ? MeetTreatment::exact
                                                   : MeetTreatment::soft;
        if (point >= 0) {
            // Three planes always meet.
            if (edges_.facets_of_vertex[point].size() == 3) continue;
            for (Incidence& incidence : incidences_) {
                if (incidence.point != point || wanted.count(incidence.facet) == 0) continue;
                incidence.how = how;
                incidence.sigma = reading.sigma / scale_;
                incidence.reading = static_cast<int>(r);
            }
            continue;
        }
        if (reading.released) {
            throw InputError(
                reading.file, reading.line,
                fmt::format("meet '{}': these facets do not meet in the mesh, so there "
                            "is nothing to release",
                            reading.id));
        }
        // A meet that the mesh does not have is a point of its own, near the facets' corners.
        Vec3 start(0);
        for (int f : reading.facets) {
            start +=
                corner_mean(solid_, solid_.facets[f]) / static_cast<double>(reading.facets.size());
        }
        mesh_shape_.points.push_back(start);
        for (int f : reading.facets) {
            incidences_.push_back({static_cast<int>(mesh_shape_.points.size()) - 1, f, how,
                                   reading.sigma / scale_, static_cast<int>(r)});
        }
    }
    splits_ = options.free_corners ||
              std::any_of(incidences_.begin(), incidences_.end(),
                          [](const Incidence& i) { return i.how != MeetTreatment::exact; });
}

bool System::has_common_meets() const {
    return std::any_of(incidences_.begin(), incidences_.end(), [](const Incidence& i) {
        return i.how == MeetTreatment::soft && i.sigma == 0;
    });
}

bool System::has_estimated_groups() const {
    return estimates_meets_ && has_common_meets();
}

void System::add_extras() {
    first_extra_.assign(readings_.size(), -1);
    for (std::size_t r = 0; r < readings_.size(); ++r) {
        const Reading& reading = readings_[r];
        if (reading.kind != ReadingKind::rotation && reading.kind != ReadingKind::mirror) continue;
        first_extra_[r] = static_cast<int>(mesh_shape_.extras.size());
        if (reading.kind == ReadingKind::rotation) {
            mesh_shape_.extras.insert(mesh_shape_.extras.end(), {0.0, 0.0});
            continue;
        }
        mesh_shape_.extras.push_back(0.0);  // how far the plane lies from the middle
        if (reading.has_direction) continue;
        // Normals of a pair differ along the mirror's normal, up to sign: the mean of doubled
        // angles.
        double east = 0, north = 0;
        for (std::size_t i = 0; i + 1 < reading.facets.size(); i += 2) {
            const Vec3 d =
                mesh_shape_.normals[reading.facets[i]] - mesh_shape_.normals[reading.facets[i + 1]];
            east += d.x * d.x - d.y * d.y;
            north += 2 * d.x * d.y;
        }
        mesh_shape_.extras.push_back(0.5 * std::atan2(north, east));
    }
}

bool System::is_girdle(int facet) const {
    return std::abs(solid_.facets[facet].plane.normal.z) <
           std::sin(radians(k_frame.girdle_tilt_deg));
}

double System::half_width() const {
    double widest = 0;
    for (int k = 0; k < k_frame.width_directions; ++k) {
        const double a = std::numbers::pi * k / k_frame.width_directions;
        widest = std::max(widest, width_along(solid_, Vec3{std::cos(a), std::sin(a), 0}));
    }
    return 0.5 * widest;
}

double System::unit_of(const Reading& reading) const {
    switch (reading.kind) {
        case ReadingKind::inclination:
        case ReadingKind::azimuth:
        case ReadingKind::dihedral:
        case ReadingKind::parallel:
        case ReadingKind::rotation:
        case ReadingKind::mirror:
            return 1;
        case ReadingKind::volume:
            return std::pow(scale_ * mm_per(stone_.unit), 3);
        case ReadingKind::weight:
            return carat(std::pow(scale_ * mm_per(stone_.unit), 3),
                         stone_.material.density_g_cm3.value_or(1));
        default:
            return scale_;
    }
}

}  // namespace culet
