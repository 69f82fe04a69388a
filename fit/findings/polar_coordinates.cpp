#include "fit/findings/polar_coordinates.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "fit/findings/own_axis.h"
#include "fit/model/facet_functions.h"

namespace culet {

namespace {

constexpr double k_level_sine = 0.05;

}  // namespace

PolarCoordinates polar_coordinates(const FitModel& model, const Shape& shape,
                                   const RowWriter& writer, const std::vector<Tier>& tiers) {
    const AxisEstimate estimate = own_axis(model, shape, tiers, nullptr);
    const Vec3 axis = estimate.axis.direction, east = estimate.east, north = estimate.north;
    const Vec3 middle = middle_of(shape);
    const std::size_t count = shape.normals.size();
    PolarCoordinates c;
    std::vector<Quantity> quantities;
    c.placement = Eigen::MatrixXd::Zero(Eigen::Index(3 * count), 4);
    for (std::size_t f = 0; f < count; ++f) {
        const int facet = static_cast<int>(f);
        const Vec3& n = shape.normals[f];
        const double x = glm::dot(n, east), y = glm::dot(n, north), z = glm::dot(n, axis);
        const double s = std::hypot(x, y);
        c.polar.push_back(std::atan2(s, z));
        c.azimuth.push_back(std::atan2(y, x));
        c.sine.push_back(s);
        c.distance.push_back(shape.offsets[f] - glm::dot(n, middle));
        c.across.push_back({x, y});
        c.level.push_back(s < k_level_sine);
        Vec3 first = east, second = north;
        if (!c.level.back()) {
            const Vec3 outwards = (x * east + y * north) / s;
            first = z * outwards - s * axis;
            second = glm::cross(axis, outwards);
        }
        Quantity a, b, d;
        a.add(Quantity::By::normal, facet, first);
        b.add(Quantity::By::normal, facet, second);
        d.add(Quantity::By::normal, facet, -middle);
        d.add(Quantity::By::offset, facet, 1.0);
        quantities.insert(quantities.end(), {a, b, d});
        const Eigen::Index row = Eigen::Index(3 * f);
        // Relative to an axis turned by a small w, the stone turns by -w.
        const std::array<Vec3, 2> turns{east, north};
        for (Eigen::Index k = 0; k < 2; ++k) {
            const Vec3 change = -glm::cross(turns[std::size_t(k)], n);
            c.placement(row, k) = glm::dot(first, change);
            c.placement(row + 1, k) = glm::dot(second, change);
            c.placement(row + 2, k + 2) = -glm::dot(n, turns[std::size_t(k)]);
        }
    }
    c.rows = Eigen::MatrixXd(writer.functions(quantities));
    if (estimate.axis.known) {
        // The axis moves with the facets: towards east by a turn about north.
        const Eigen::MatrixXd moves = writer.functions(estimate.across);
        c.rows += c.placement.col(1) * moves.row(0) - c.placement.col(0) * moves.row(1);
    }
    return c;
}

SymmetricModel symmetric_model(const PolarCoordinates& c, const AxisGroup& group) {
    const double pi = std::numbers::pi, step = 2 * pi / group.order;
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(Eigen::Index(3 * c.polar.size()));
    SymmetricModel model{none, {}};
    std::vector<Eigen::VectorXd> columns;
    Eigen::VectorXd plane = none;
    for (const FacetOrbit& orbit : orbits_of(group, c.polar.size())) {
        const auto mean = [&](const std::vector<double>& of) {
            double sum = 0;
            for (const int f : orbit.facets) sum += of[std::size_t(f)];
            return sum / double(orbit.facets.size());
        };
        const std::size_t first = std::size_t(orbit.facets.front());
        const double distance = mean(c.distance), polar = mean(c.polar);
        Eigen::VectorXd& shared_distance = columns.emplace_back(none);
        for (const int f : orbit.facets) {
            model.deviations(3 * f + 2) = c.distance[std::size_t(f)] - distance;
            shared_distance(3 * f + 2) = 1;
        }
        if (c.level[first] && orbit.facets.size() == 1) {
            if (group.is_trivial()) continue;
            const Eigen::Index row = Eigen::Index(3 * first);
            model.deviations(row) = c.across[first][0];
            model.deviations(row + 1) = c.across[first][1];
            if (group.order > 1) continue;
            // With a mirror alone it may lean within the plane.
            Eigen::VectorXd& lean = columns.emplace_back(none);
            lean(row) = std::cos(group.plane);
            lean(row + 1) = std::sin(group.plane);
            continue;
        }
        // Facets in a mirror have its azimuth or the opposite one; others have their own.
        const bool is_own = orbit.own_mirror < 0;
        const double in_plane = group.plane + 0.5 * orbit.mirror.steps * step;
        const double azimuth0 =
            is_own ? c.azimuth[first]
                   : in_plane + pi * std::round((c.azimuth[first] - in_plane) / pi);
        Eigen::VectorXd shared_polar = none, own_azimuth = none;
        for (std::size_t i = 0; i < orbit.facets.size(); ++i) {
            const std::size_t f = std::size_t(orbit.facets[i]);
            const AxisGroup::Element& e = orbit.from_first[i];
            const Eigen::Index row = Eigen::Index(3 * f);
            const double nominal =
                e.steps * step + (e.mirrored ? 2 * group.plane - azimuth0 : azimuth0);
            const double s = c.sine[f];
            model.deviations(row) = c.polar[f] - polar;
            model.deviations(row + 1) = s * std::remainder(c.azimuth[f] - nominal, 2 * pi);
            shared_polar(row) = 1;
            own_azimuth(row + 1) = e.mirrored ? -s : s;
            if (!is_own || e.mirrored) plane(row + 1) = is_own ? 2 * s : s;
        }
        columns.push_back(std::move(shared_polar));
        if (is_own) columns.push_back(std::move(own_azimuth));
    }
    if (group.mirrors) columns.push_back(std::move(plane));
    model.columns.resize(none.size(), Eigen::Index(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
        model.columns.col(Eigen::Index(k)) = columns[k];
    }
    return model;
}

}  // namespace culet
