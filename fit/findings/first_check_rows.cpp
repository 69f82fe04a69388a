#include "fit/findings/first_check_rows.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <optional>

#include "fit/model/azimuth_turn.h"
#include "stone/design/tiers.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

// Facets more level than this have no usable azimuth.
constexpr double k_no_azimuth = radians(5);
// With fewer azimuths, or more scatter, their zero is unknown.
constexpr std::size_t k_fewest_azimuths = 4;
constexpr double k_no_agreement = radians(10);

class Rows {
public:
    Rows(const Stone& stone, const std::vector<Reading>& readings, const Vec3& up)
        : stone_(stone), up_(up) {
        turn_ = azimuth_turn(
            readings, [&](int facet) { return normal(facet); }, stone.azimuth_from_mesh);
    }

    // The reading's quantity in the mesh, if it can be told.
    std::optional<double> in_mesh(const Reading& r) const;

private:
    Vec3 normal(int facet) const { return stone_.solid.facets[std::size_t(facet)].plane.normal; }
    std::optional<double> in_mesh_angle(const Reading& r) const;
    double table_width(const Vec3& direction) const;

    const Stone& stone_;
    Vec3 up_;
    double turn_ = 0;  // from the mesh's azimuths to those read
};

std::optional<double> Rows::in_mesh_angle(const Reading& r) const {
    const bool is_mean = r.kind == ReadingKind::inclination && r.aggregate == Aggregate::mean;
    const bool is_single = r.aggregate == Aggregate::single && r.facets.size() == 1;
    if (r.facets.empty() || r.datum.kind != Datum::Kind::up || !(is_mean || is_single)) return {};
    double mean = 0;
    for (const int f : r.facets) mean += inclination(normal(f), up_) / double(r.facets.size());
    if (r.kind == ReadingKind::inclination) return mean;
    if (!(mean > k_no_azimuth)) return {};
    return azimuth(normal(r.facets[0])) + turn_;
}

double Rows::table_width(const Vec3& direction) const {
    Solid table;
    const int facet = find_facet(stone_.solid, stone_.up_facet);
    if (facet < 0) return 0;
    for (const int corner : stone_.solid.facets[std::size_t(facet)].corners) {
        table.vertices.push_back(stone_.solid.vertices[std::size_t(corner)]);
    }
    return width_along(table, direction);
}

std::optional<double> Rows::in_mesh(const Reading& r) const {
    if (r.kind == ReadingKind::inclination || r.kind == ReadingKind::azimuth) {
        return in_mesh_angle(r);
    }
    if (r.aggregate != Aggregate::single || !(r.value > 0)) return {};
    const double a = r.azimuth - turn_;
    const Vec3 across = r.has_direction ? r.direction : Vec3{std::cos(a), std::sin(a), 0};
    const double mm3 = volume(stone_.solid) * std::pow(mm_per(stone_.unit), 3);
    double mesh = 0;
    if (r.kind == ReadingKind::width) mesh = width_along(stone_.solid, across);
    if (r.kind == ReadingKind::table_width) mesh = table_width(across);
    if (r.kind == ReadingKind::depth) mesh = width_along(stone_.solid, stone_.up);
    if (r.kind == ReadingKind::volume) mesh = mm3;
    if (r.kind == ReadingKind::weight) {
        mesh = carat(mm3, stone_.material.density_g_cm3.value_or(0));
    }
    if (!(mesh > 0)) return {};
    return mesh;
}

double half_turn(double angle) {
    return std::remainder(angle, 2 * std::numbers::pi);
}

// Azimuths count from their own mark: the median difference from the mesh. They are not checked if
// they do not agree on it.
void turn_azimuths(std::vector<CheckedRow>& rows) {
    std::vector<double> off;
    for (CheckedRow& row : rows) {
        if (row.kind != ReadingKind::azimuth) continue;
        row.mesh = row.value - half_turn(row.off());
        off.push_back(row.off());
    }
    if (off.size() < k_fewest_azimuths || !(robust_sigma(off) < k_no_agreement)) {
        std::erase_if(rows, [](const CheckedRow& r) { return r.kind == ReadingKind::azimuth; });
        return;
    }
    const double middle = median(off);
    for (CheckedRow& row : rows) {
        if (row.kind == ReadingKind::azimuth) {
            row.mesh = row.value - half_turn(row.off() - middle);
        }
    }
}

}  // namespace

double CheckedRow::off() const {
    return is_angle(kind) ? value - mesh : std::log(value / mesh);
}

double CheckedRow::at(double off) const {
    return is_angle(kind) ? mesh + off : mesh * std::exp(off);
}

std::vector<CheckedRow> checked_rows(const Stone& stone, const std::vector<Reading>& readings,
                                     const Vec3& up, const std::vector<NamedTier>& tiers) {
    const std::vector<int> tier_of = tier_of_each(tiers, stone.solid.facets.size());
    const Rows mesh(stone, readings, up);
    std::vector<CheckedRow> rows;
    std::map<std::pair<std::string, long>, std::size_t> known;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const Reading& r = readings[i];
        const std::optional<double> drawn = r.exact ? std::nullopt : mesh.in_mesh(r);
        if (!drawn) continue;
        if (r.kind == ReadingKind::inclination && r.line > 0) {
            const auto [at, fresh] = known.try_emplace({r.file.string(), r.line}, rows.size());
            if (!fresh) {
                rows[at->second].readings.push_back(i);
                continue;
            }
        }
        CheckedRow row{
            {i}, r.kind, r.value, std::hypot(r.sigma, r.rounding / std::sqrt(12.0)), *drawn};
        row.line = r.line;
        if (is_angle(r.kind)) {
            row.tier = tier_of[std::size_t(r.facets[0])];
            row.facet = r.aggregate == Aggregate::mean ? -1 : r.facets[0];
        }
        rows.push_back(std::move(row));
    }
    turn_azimuths(rows);
    return rows;
}

double robust_sigma(const std::vector<double>& values) {
    if (values.size() < 3) return 0;
    const double middle = median(values);
    std::vector<double> off;
    for (const double v : values) off.push_back(std::abs(v - middle));
    return 1.4826 * median(std::move(off));  // sigma of a normal distribution
}

}  // namespace culet
