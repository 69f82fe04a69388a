// What outlines tell of the planes as equations of the fit.

#include <cmath>
#include <glm/geometric.hpp>

#include "fit/model/orbits.h"
#include "fit/model/system.h"
#include "fit/model/upright_turn.h"
#include "fit/silhouettes/silhouette_fit.h"
#include "stone/errors.h"

namespace culet {

namespace {

// About up, from where the stone was seen to where it stands now: of all normals together, those
// that look sideways more.
double turn_about_up(const OutlineRows& seen, const Shape& shape) {
    double along = 0, across = 0;
    for (std::size_t f = 0; f < seen.normals.size(); ++f) {
        const Vec3 &was = seen.normals[f], &is = shape.normals[f];
        along += was.x * is.x + was.y * is.y;
        across += was.x * is.y - was.y * is.x;
    }
    return along == 0 && across == 0 ? 0 : std::atan2(across, along);
}

// The turn's own derivative is left out: to a turn of the whole stone a row is blind.
Formula row_of(const std::shared_ptr<const OutlineRows>& seen, std::size_t k) {
    return [seen, k](const Shape& shape) {
        const OutlineRows::Row& row = seen->rows[k];
        const double turn = seen->turns ? turn_about_up(*seen, shape) : 0;
        const double cosine = std::cos(turn), sine = std::sin(turn);
        Quantity q;
        q.slopes.reserve(2 * row.normal.size());
        for (std::size_t f = 0; f < row.normal.size(); ++f) {
            const Vec3 &a = row.normal[f], &n = shape.normals[f];
            if (a == Vec3(0) && row.offset[f] == 0) continue;
            const Vec3 turned{cosine * a.x - sine * a.y, sine * a.x + cosine * a.y, a.z};
            q.value += glm::dot(turned, n) - glm::dot(a, seen->normals[f]) +
                       row.offset[f] * (shape.offsets[f] - seen->offsets[f]);
            q.add(Quantity::By::normal, int(f), turned);
            q.add(Quantity::By::offset, int(f), row.offset[f]);
        }
        return q;
    };
}

}  // namespace

void System::bring_outlines_inside() {
    const OutlineKnowledge* told = nullptr;
    for (const Reading& r : readings_) {
        if (r.told) told = r.told.get();
    }
    if (told == nullptr) return;
    check(told->planes.size() == solid_.facets.size(), "outlines of another mesh");
    const glm::dmat3 turn = turn_about_z(turn_);
    const auto inside = [&](const Vec3& direction) { return turn * times(upright_, direction); };
    auto rows = std::make_shared<OutlineRows>();
    for (const Plane& plane : told->planes) {
        rows->normals.push_back(inside(plane.normal));
        rows->offsets.push_back((plane.offset - glm::dot(plane.normal, middle_)) / scale_);
    }
    for (const OutlineKnowledge::Row& row : told->rows) {
        OutlineRows::Row& in = rows->rows.emplace_back();
        for (std::size_t f = 0; f < row.normal.size(); ++f) {
            // The offset from the mesh's middle is smaller by normal . middle.
            in.normal.push_back(inside(row.normal[f] + row.offset[f] * middle_));
            in.offset.push_back(row.offset[f] * scale_);
        }
    }
    rows->turns = !stone_.azimuth_from_mesh;
    outlines_ = std::move(rows);
}

std::vector<Equation> System::silhouette_equations() const {
    std::vector<Equation> all;
    if (!outlines_) return all;
    for (std::size_t k = 0; k < outlines_->rows.size(); ++k) {
        Equation e;
        e.role = Equation::Role::outlines;
        e.formula = row_of(outlines_, k);
        all.push_back(std::move(e));
    }
    return all;
}

}  // namespace culet
