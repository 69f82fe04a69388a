#include "fit/findings/polar_coordinates.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "fit/findings/own_axis.h"

namespace culet {

namespace {

constexpr double k_level_sine = 0.05;

double wrapped(double angle) {
    return std::remainder(angle, 2 * std::numbers::pi);
}

}  // namespace

PolarCoordinates polar_coordinates(const FitModel& model, const Shape& shape,
                                   const RowWriter& writer, const std::vector<Tier>& tiers) {
    const AxisEstimate estimate = own_axis(model, shape, tiers, nullptr);
    const Vec3 axis = estimate.axis.known ? estimate.axis.direction : Vec3{0, 0, 1};
    // Azimuths about the axis begin where those about up do.
    const Vec3 east = glm::normalize(Vec3{1, 0, 0} - axis.x * axis);
    const Vec3 north = glm::cross(axis, east);
    Vec3 middle(0);
    for (const Vec3& p : shape.points) middle += p / double(shape.points.size());

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
        // An axis turned by a small w sees the stone turned by -w.
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
        // The axis itself moves with the facets: d(axis) = w x axis.
        const Eigen::MatrixXd moves = writer.functions(estimate.across);
        for (std::size_t i = 0; i < estimate.across.size(); ++i) {
            const Vec3 w = glm::cross(axis, estimate.directions[i]);
            c.rows +=
                (c.placement.col(0) * glm::dot(w, east) + c.placement.col(1) * glm::dot(w, north)) *
                moves.row(Eigen::Index(i));
        }
    }
    return c;
}

SymmetricModel symmetric_model(const PolarCoordinates& c, const AxisGroup& group) {
    const std::size_t count = c.polar.size();
    const double pi = std::numbers::pi;
    const double step = 2 * pi / group.order;
    SymmetricModel model;
    model.deviations = Eigen::VectorXd::Zero(Eigen::Index(3 * count));
    std::vector<Eigen::VectorXd> columns;
    const auto column = [&]() -> Eigen::VectorXd& {
        columns.push_back(Eigen::VectorXd::Zero(Eigen::Index(3 * count)));
        return columns.back();
    };
    Eigen::VectorXd plane = Eigen::VectorXd::Zero(Eigen::Index(3 * count));
    for (const FacetOrbit& orbit : orbits_of(group, count)) {
        const std::size_t first = std::size_t(orbit.facets.front());
        double distance = 0, polar = 0;
        for (int f : orbit.facets) {
            distance += c.distance[std::size_t(f)] / double(orbit.facets.size());
            polar += c.polar[std::size_t(f)] / double(orbit.facets.size());
        }
        Eigen::VectorXd shared_distance = Eigen::VectorXd::Zero(Eigen::Index(3 * count));
        for (int f : orbit.facets) {
            const Eigen::Index row = Eigen::Index(3 * f);
            model.deviations(row + 2) = c.distance[std::size_t(f)] - distance;
            shared_distance(row + 2) = 1;
        }
        column() = shared_distance;

        const Eigen::Index row0 = Eigen::Index(3 * first);
        if (c.level[first] && orbit.facets.size() == 1) {
            if (group.is_trivial()) continue;
            model.deviations(row0) = c.across[first][0];
            model.deviations(row0 + 1) = c.across[first][1];
            if (group.order == 1) {
                // In a mirror alone it may lean within the plane.
                Eigen::VectorXd& lean = column();
                lean(row0) = std::cos(group.plane);
                lean(row0 + 1) = std::sin(group.plane);
            }
            continue;
        }
        // Facets that lie in a mirror have its azimuth, or stand opposite; others their own.
        double azimuth0 = c.azimuth[first];
        if (orbit.own_mirror >= 0) {
            const double in_plane = group.plane + 0.5 * orbit.mirror.steps * step;
            azimuth0 = in_plane + pi * std::round((c.azimuth[first] - in_plane) / pi);
        }
        Eigen::VectorXd shared_polar = Eigen::VectorXd::Zero(Eigen::Index(3 * count));
        Eigen::VectorXd own_azimuth = Eigen::VectorXd::Zero(Eigen::Index(3 * count));
        for (std::size_t i = 0; i < orbit.facets.size(); ++i) {
            const std::size_t f = std::size_t(orbit.facets[i]);
            const AxisGroup::Element& e = orbit.from_first[i];
            const Eigen::Index row = Eigen::Index(3 * f);
            const double nominal = e.mirrored ? 2 * group.plane + e.steps * step - azimuth0
                                              : azimuth0 + e.steps * step;
            const double s = c.sine[f];
            model.deviations(row) = c.polar[f] - polar;
            model.deviations(row + 1) = s * wrapped(c.azimuth[f] - nominal);
            shared_polar(row) = 1;
            if (orbit.own_mirror >= 0) {
                plane(row + 1) = s;
            } else {
                own_azimuth(row + 1) = e.mirrored ? -s : s;
                if (e.mirrored) plane(row + 1) = 2 * s;
            }
        }
        column() = shared_polar;
        if (orbit.own_mirror < 0) column() = own_azimuth;
    }
    if (group.mirrors) column() = plane;
    model.columns.resize(Eigen::Index(3 * count), Eigen::Index(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k)
        model.columns.col(Eigen::Index(k)) = columns[k];
    return model;
}

}  // namespace culet
