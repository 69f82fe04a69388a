#include "fit/starts/starts.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "fit/mesh/roughness.h"
#include "fit/model/azimuth_turn.h"
#include "fit/model/canonical.h"
#include "fit/model/enclosed.h"
#include "fit/model/orbits.h"
#include "fit/starts/closing_sides.h"
#include "fit/starts/constants.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/solid/checks.h"
#include "stone/upright.h"

namespace culet {

namespace {

Vec3 mean_of(const std::vector<Vec3>& points, std::size_t count) {
    Vec3 mean(0);
    for (std::size_t i = 0; i < count; ++i) mean += points[i] / double(count);
    return mean;
}

glm::dmat3 to_glm(const Eigen::Matrix3d& m) {
    glm::dmat3 result;
    for (int k = 0; k < 3; ++k) result[k] = {m(0, k), m(1, k), m(2, k)};
    return result;
}

// Maps points x to m x + shift, and planes with them.
Shape mapped(Shape shape, const glm::dmat3& m, const Vec3& shift) {
    const glm::dmat3 of_normals = glm::transpose(glm::inverse(m));
    for (std::size_t f = 0; f < shape.normals.size(); ++f) {
        const Vec3 n = of_normals * shape.normals[f];
        const double length = glm::length(n);
        shape.normals[f] = n / length;
        shape.offsets[f] = shape.offsets[f] / length + glm::dot(shape.normals[f], shift);
    }
    for (Vec3& p : shape.points) p = m * p + shift;
    return shape;
}

struct Moments {
    Eigen::Matrix3d cross = Eigen::Matrix3d::Zero(), own = Eigen::Matrix3d::Zero();
    Vec3 from{0, 0, 0}, to{0, 0, 0};
};
Moments moments(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    Moments m;
    m.from = mean_of(from, from.size());
    m.to = mean_of(to, from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 a = from[i] - m.from, b = to[i] - m.to;
        const Eigen::Vector3d p(a.x, a.y, a.z), q(b.x, b.y, b.z);
        m.cross += q * p.transpose();
        m.own += p * p.transpose();
    }
    return m;
}

}  // namespace

Starts::Starts(const FitModel& model) : model_(model) {
    const Shape& mesh = model.mesh_shape();
    double worst = 0;
    for (const Incidence& i : model.meets().incidences) {
        if (i.point >= static_cast<int>(model.stone().solid.vertices.size())) continue;
        worst = std::max(worst, std::abs(glm::dot(mesh.normals[i.facet], mesh.points[i.point]) -
                                         mesh.offsets[i.facet]));
    }
    // Root mean square: a small facet drawn slightly askew has a few large heights.
    double squares = 0;
    const std::vector<std::pair<int, int>> hinges = hinges_of(model);
    for (const auto& [f, p] : hinges) {
        const double above =
            std::max(0.0, glm::dot(mesh.normals[f], mesh.points[p]) - mesh.offsets[f]);
        squares += above * above;
    }
    mesh_is_good_ =
        worst < k_drawn.drawn_with_care &&
        squares <= k_drawn.nearly_convex * k_drawn.nearly_convex * double(hinges.size());
    find_sides();
}

void Starts::make_canonical() {
    if (canonical_made_) return;
    canonical_made_ = true;
    canonical_ = canonical_polyhedron(model_.stone().solid, model_.edges());
}

std::optional<Start> Starts::next() {
    while (true) {
        std::optional<Start> start;
        bool without_sides = false;
        // A mesh drawn with care comes first, so that undetermined directions stay as drawn.
        switch (at_++) {
            case 0:
                if (mesh_is_good_) start = mesh();
                break;
            case 1:
                start = similar();
                break;
            case 2:
                if (!mesh_is_good_) start = mesh();
                break;
            case 3:
                start = from_angles(similar(), "canonical with the angles read");
                break;
            case 4:
                without_sides = true;
                if (std::any_of(sides_.begin(), sides_.end(), [](int s) { return s != 0; })) {
                    start = similar();
                }
                break;
            case 5:
                start = affine();
                break;
            case 6:
                start = from_angles(mesh(), "mesh with the angles read");
                break;
            default:
                return std::nullopt;
        }
        if (start) {
            // The mesh may be wrong about sides: one start ignores them.
            if (!without_sides) start->sides = sides_;
            return start;
        }
    }
}

// The mesh decides a facet's side when it separates the two values of the reading by more than the
// tilt error that its corners cause.
void Starts::find_sides() {
    const Shape& mesh = model_.mesh_shape();
    sides_.assign(mesh.normals.size(), 0);
    for (const Reading& r : model_.readings()) {
        // Unless the facet may be upright.
        if (r.side != 0 && std::numbers::pi / 2 - r.value > k_drawn.upright_sigmas * r.sigma) {
            for (const int f : r.facets) sides_[std::size_t(f)] = r.side;
        }
    }
    const std::optional<MeshRoughness> rough = MeshRoughness::of(model_);
    if (!rough) return;
    for (const Reading& r : model_.readings()) {
        if (r.kind != ReadingKind::inclination || r.datum.kind != Datum::Kind::up ||
            r.aggregate != Aggregate::single || r.side != 0) {
            continue;
        }
        const int f = r.facets[0];
        const double z = std::clamp(mesh.normals[f].z, -1.0, 1.0);
        const double drawn = std::acos(z);
        const double as_up = std::abs(drawn - r.value),
                     as_down = std::abs(drawn - (std::numbers::pi - r.value));
        if (std::abs(as_up - as_down) > k_drawn.known_side * rough->tilt(f))
            sides_[f] = as_up < as_down ? 1 : -1;
    }
    // Scanned girdles need this: without it 3 of 10 rough meshes with such girdles were lost, and
    // the others took four times as long (bench/corpus_bench.cpp). Not under exact symmetry, where
    // facets that were not read follow others.
    if (model_.symmetries().exact_motions().empty())
        sides_ = closing_sides(model_, std::move(sides_), rough->corner());
}

Shape looking_as(const FitModel& model, Shape shape, const std::vector<int>& sides) {
    for (std::size_t f = 0; f < sides.size(); ++f) {
        Vec3& n = shape.normals[f];
        if (static_cast<int>(f) == model.frame().up_facet() || !(sides[f] * n.z < 0)) continue;
        n.z = -n.z;
        Vec3 mean(0);
        const std::vector<int>& loop = model.mesh_outline()->loops[f];
        for (int corner : loop) mean += shape.points[corner] / double(loop.size());
        shape.offsets[f] = glm::dot(n, mean);
    }
    return shape;
}

Start Starts::mesh() const {
    return {"mesh", model_.mesh_shape(), false, false, {}};
}

// Levels the up facet and turns azimuths to those read.
Shape Starts::upright(Shape shape) const {
    if (model_.frame().up_facet() >= 0) {
        const Vec3 n = shape.normals[model_.frame().up_facet()];
        shape = mapped(std::move(shape), turn_upright(n), Vec3(0));
        shape.normals[model_.frame().up_facet()] = Vec3{0, 0, 1};
    }
    const double angle = azimuth_turn(
        model_.readings(), [&](int facet) { return shape.normals[facet]; }, false);
    return turned_about_z(std::move(shape), angle);
}

// Similarity transform by Umeyama (1991).
std::optional<Start> Starts::similar() {
    make_canonical();
    if (!canonical_) return std::nullopt;
    const Shape& mesh = model_.mesh_shape();
    const Moments m = moments(canonical_->points, mesh.points);
    const SingularValues parts = singular_values(m.cross);
    const Eigen::Matrix3d u = parts.u, v = parts.v;
    Eigen::Vector3d sign(1, 1, 1);
    if (determinant3(u * v.transpose()) < 0) sign(2) = -1;
    const double scale = sign.dot(Eigen::Vector3d(parts.values)) / m.own.trace();
    if (!(scale > 0) || !std::isfinite(scale)) return std::nullopt;
    const glm::dmat3 map = to_glm(scale * (u * sign.asDiagonal() * v.transpose()));
    return over_mesh("canonical", mapped(*canonical_, map, m.to - map * m.from));
}

// A start from the canonical polyhedron laid over the mesh. Points that it lacks are the mesh's.
Start Starts::over_mesh(const std::string& name, Shape shape) const {
    const Shape& mesh = model_.mesh_shape();
    Start start{name, std::move(shape), false, true, {}};
    start.shape.extras = mesh.extras;
    for (std::size_t p = start.shape.points.size(); p < mesh.points.size(); ++p) {
        start.shape.points.push_back(mesh.points[p]);
        start.is_convex = false;
    }
    start.shape = upright(std::move(start.shape));
    return start;
}

std::optional<Start> Starts::affine() {
    make_canonical();
    if (!canonical_) return std::nullopt;
    const Shape& mesh = model_.mesh_shape();
    const Moments m = moments(canonical_->points, mesh.points);
    const Eigen::Matrix3d map = m.cross * inverse3(m.own);
    const Eigen::VectorXd stretches = singular_values(map).values;
    // A mesh that is inside out or crushed flat does not tell proportions.
    if (!(determinant3(map) > 0) || !(stretches(2) > k_drawn.least_stretch * stretches(0))) {
        return std::nullopt;
    }
    return over_mesh("canonical, as long and wide as the mesh",
                     mapped(*canonical_, to_glm(map), m.to - to_glm(map) * m.from));
}

std::optional<Start> Starts::from_angles(std::optional<Start> base, const std::string& name) const {
    if (!base) return base;
    Shape& shape = base->shape;
    const std::size_t facets = shape.normals.size();
    std::vector<double> tilt(facets, -1), turn(facets, 0);
    std::vector<bool> turned(facets, false);
    bool any = false;
    for (const Reading& r : model_.readings()) {
        if (r.datum.kind != Datum::Kind::up || r.facets.empty()) continue;
        for (int f : r.facets) {
            if (r.kind == ReadingKind::inclination) {
                tilt[f] = r.value;
                any = true;
            }
            if (r.kind == ReadingKind::azimuth) {
                turn[f] = r.value;
                turned[f] = true;
                any = true;
            }
        }
    }
    if (!any) return std::nullopt;
    const Vec3 middle = mean_of(shape.points, shape.points.size());
    for (std::size_t f = 0; f < facets; ++f) {
        if (static_cast<int>(f) == model_.frame().up_facet()) continue;
        Vec3& n = shape.normals[f];
        const double flat = std::hypot(n.x, n.y);
        const double inclination = tilt[f] >= 0 ? tilt[f] : std::atan2(flat, std::abs(n.z));
        const double azimuth = turned[f] ? turn[f] : std::atan2(n.y, n.x);
        n = {std::sin(inclination) * std::cos(azimuth), std::sin(inclination) * std::sin(azimuth),
             std::cos(inclination)};
        // Inclinations do not tell the side; the facet's place does, better than the normal of a
        // rough mesh.
        Vec3 mean(0);
        const std::vector<int>& loop = model_.mesh_outline()->loops[f];
        for (int corner : loop) mean += shape.points[corner] / double(loop.size());
        if (sides_[f] != 0) {
            n.z = std::copysign(n.z, sides_[f]);
        } else if (glm::dot(n, mean - middle) < glm::dot(Vec3{n.x, n.y, -n.z}, mean - middle)) {
            n.z = -n.z;
        }
        shape.offsets[f] = glm::dot(n, mean);
    }
    base->name = name;
    base->keep_normals_at_first = true;
    base->is_convex = false;
    return base;
}

}  // namespace culet
