// Makes equations of the planes known from outlines and photographs.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "fit/model/equations.h"
#include "fit/model/known_planes.h"
#include "fit/silhouettes/silhouette_fit.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Turn about up from the stone as seen to the shape now: the mean over all normals, weighted by how
// far they look sideways.
double turn_about_up(const KnownPlanes& seen, const Shape& shape) {
    double along = 0, across = 0;
    for (std::size_t f = 0; f < seen.planes.size(); ++f) {
        const Vec3 &was = seen.planes[f].normal, &is = shape.normals[f];
        along += was.x * is.x + was.y * is.y;
        across += was.x * is.y - was.y * is.x;
    }
    return along == 0 && across == 0 ? 0 : std::atan2(across, along);
}

// Removes from the slopes the parts along motions that a row cannot see (shifts, and a turn about
// up). Where the normals differ slightly from those seen, the row would appear to see them.
class BlindToMotions {
public:
    explicit BlindToMotions(const Shape& shape) : shape_(shape) {
        glm::dmat3 sum(0.0);
        for (const Vec3& n : shape.normals) {
            sum += glm::outerProduct(n, n);
            turn_size_ += n.x * n.x + n.y * n.y;
        }
        inverse_ = glm::inverse(sum);
    }
    void take_out(bool turns, std::vector<Vec3>& normal, std::vector<double>& offset) const {
        Vec3 shift(0);
        double turn = 0;
        for (std::size_t f = 0; f < normal.size(); ++f) {
            shift += offset[f] * shape_.normals[f];
            turn += glm::dot(normal[f], turned(f));
        }
        shift = inverse_ * shift;
        if (turn_size_ > 0) turn /= turn_size_;
        for (std::size_t f = 0; f < normal.size(); ++f) {
            offset[f] -= glm::dot(shift, shape_.normals[f]);
            if (turns) normal[f] -= turn * turned(f);
        }
    }

private:
    Vec3 turned(std::size_t f) const { return {-shape_.normals[f].y, shape_.normals[f].x, 0}; }
    const Shape& shape_;
    glm::dmat3 inverse_{1.0};
    double turn_size_ = 0;
};

Formula row_of(const std::shared_ptr<const KnownPlanes>& seen, std::size_t k) {
    return [seen, k](const Shape& shape) {
        const PlaneObservations::Row& row = seen->rows[k];
        const double turn = seen->turns ? turn_about_up(*seen, shape) : 0;
        const double cosine = std::cos(turn), sine = std::sin(turn);
        Quantity q;
        std::vector<Vec3> normal;
        std::vector<double> offset = row.offset;
        for (std::size_t f = 0; f < row.normal.size(); ++f) {
            const Vec3& a = row.normal[f];
            normal.emplace_back(cosine * a.x - sine * a.y, sine * a.x + cosine * a.y, a.z);
            q.value += glm::dot(normal[f], shape.normals[f]) - glm::dot(a, seen->planes[f].normal) +
                       offset[f] * (shape.offsets[f] - seen->planes[f].offset);
        }
        BlindToMotions(shape).take_out(seen->turns, normal, offset);
        q.slopes.reserve(2 * normal.size());
        for (std::size_t f = 0; f < normal.size(); ++f) {
            q.add(Quantity::By::normal, int(f), normal[f]);
            q.add(Quantity::By::offset, int(f), offset[f]);
        }
        return q;
    };
}

std::shared_ptr<const KnownPlanes> inside(const Frame& frame, Frame::From from,
                                          const PlaneObservations& observed, bool turns) {
    check(observed.planes.size() == frame.solid().facets.size(), "planes of another mesh");
    const glm::dmat3 turn = frame.turn_inside(from);
    const Vec3& middle = frame.middle();
    auto known = std::make_shared<KnownPlanes>();
    for (const Plane& plane : observed.planes) {
        known->planes.push_back(
            {turn * plane.normal, (plane.offset - glm::dot(plane.normal, middle)) / frame.scale()});
    }
    for (const PlaneObservations::Row& row : observed.rows) {
        PlaneObservations::Row& in = known->rows.emplace_back();
        in.value = row.value;
        for (std::size_t f = 0; f < row.normal.size(); ++f) {
            // Offsets inside are measured from the mesh's middle.
            in.normal.push_back(turn * (row.normal[f] + row.offset[f] * middle));
            in.offset.push_back(row.offset[f] * frame.scale());
        }
    }
    known->turns = turns;
    return known;
}

}  // namespace

std::vector<std::shared_ptr<const KnownPlanes>> list_known_planes(
    const Frame& frame, const std::vector<Reading>& readings, bool turns) {
    std::vector<std::shared_ptr<const KnownPlanes>> all;
    const OutlineObservations* outlines = nullptr;  // of all sets together
    for (const Reading& r : readings) {
        if (r.outline_observations) outlines = r.outline_observations.get();
        if (r.photograph) {
            all.push_back(inside(frame, Frame::From::fitted, *r.photograph, turns));
        }
    }
    if (outlines) all.push_back(inside(frame, Frame::From::mesh, *outlines, turns));
    return all;
}

std::vector<Equation> known_plane_equations(
    const std::vector<std::shared_ptr<const KnownPlanes>>& all_known) {
    std::vector<Equation> all;
    for (const auto& known : all_known) {
        for (std::size_t k = 0; k < known->rows.size(); ++k) {
            Equation e;
            e.role = Equation::Role::known_planes;
            e.value = known->rows[k].value;
            e.formula = row_of(known, k);
            all.push_back(std::move(e));
        }
    }
    return all;
}

}  // namespace culet
