// Equations of symmetry, and of parallel and coplanar facets.

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "fit/model/equations.h"
#include "fit/model/outline_corners.h"
#include "fit/model/symmetry_contrasts.h"

namespace culet {

namespace {

class RelationEquations {
public:
    RelationEquations(const FitModel& model, const Shape& shape, const Equation& base)
        : model_(model), shape_(shape), base_(base) {
        base_.role = Equation::Role::relation;
    }
    void parallel(const Reading& reading);
    void symmetry(const Reading& reading);
    std::vector<Equation> take() { return std::move(all_); }

private:
    void pair(const Reading& reading, int f, int g);
    void put(Formula formula) {
        all_.push_back(base_);
        all_.back().formula = std::move(formula);
        all_.back().value = 0;
    }

    const FitModel& model_;
    const Shape& shape_;
    Equation base_;
    std::vector<Equation> all_;
};

void RelationEquations::parallel(const Reading& reading) {
    const int first = reading.facets[0];
    const bool is_coplanar = reading.kind == ReadingKind::coplanar;
    for (std::size_t i = 1; i < reading.facets.size(); ++i) {
        const int f = reading.facets[i];
        const double sign =
            is_coplanar || glm::dot(shape_.normals[f], shape_.normals[first]) > 0 ? 1 : -1;
        for (const Vec3& t : tangents(shape_.normals[first])) {
            put(normal_difference(f, first, sign, t));
        }
        if (is_coplanar) put(offset_difference(f, first, sign));
    }
}

void RelationEquations::symmetry(const Reading& reading) {
    const auto& pairs = model_.symmetries().pairs(std::size_t(base_.reading));
    // Directions within sigma have independent errors (contrasts). Distances are compared only with
    // those of their images, so that a round girdle may be slightly out of round along its
    // circumference.
    if (reading.kind == ReadingKind::rotation && !reading.exact) {
        const double angle = radians(360.0 / reading.order);
        for (const std::vector<int>& orbit : orbits_of_pairs(pairs)) {
            for (Formula& contrast : turn_contrasts(model_.mesh_shape(), orbit, angle)) {
                put(std::move(contrast));
            }
        }
    }
    const double sigma = reading.sigma / model_.frame().unit_of(reading);
    for (const auto& [f, g] : pairs) {
        // Two facets with independent errors differ by sqrt(2) sigma.
        if (!reading.exact) base_.sigma = (f == g ? 1 : std::numbers::sqrt2) * sigma;
        pair(reading, f, g);
    }
}

// Facet f is mapped onto facet g.
void RelationEquations::pair(const Reading& reading, int f, int g) {
    const bool is_rotation = reading.kind == ReadingKind::rotation;
    const double angle = reading.order > 0 ? radians(360.0 / reading.order) : 0;
    const int extra = model_.symmetries().first_extra(std::size_t(base_.reading));
    const MirrorPlane plane{reading.has_direction ? -1 : extra + 1, extra, reading.azimuth};
    if (f == g && f == model_.frame().up_facet()) return;
    if (f == g && !is_rotation) return put(across_mirror(f, plane));
    if (f == g) {
        // Only a level facet is its own image under a turn.
        for (int k = 0; k < 2; ++k) put(horizontal_component(f, k));
        return;
    }
    const std::vector<Corner> corners = corners_of(*model_.mesh_outline(), f);
    if (!is_rotation || reading.exact) {
        for (const Vec3& t : tangents(shape_.normals[g])) {
            put(is_rotation ? turned_normal(f, g, angle, t) : mirrored_normal(f, g, plane, t));
        }
    }
    put(is_rotation ? turned_height(corners, g, angle, extra) : mirrored_height(corners, g, plane));
}

}  // namespace

std::vector<Equation> relation_equations(const FitModel& model, const Shape& shape,
                                         const Equation& base) {
    const Reading& reading = model.readings()[std::size_t(base.reading)];
    RelationEquations equations(model, shape, base);
    const bool is_symmetry =
        reading.kind == ReadingKind::rotation || reading.kind == ReadingKind::mirror;
    is_symmetry ? equations.symmetry(reading) : equations.parallel(reading);
    return equations.take();
}

}  // namespace culet
