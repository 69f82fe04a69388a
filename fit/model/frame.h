#pragma once
// The frame of the fit ("inside"): the mesh upright, its middle at the origin, half diameter 1; and
// the way back to the mesh's own frame ("outside").

#include <vector>

#include "fit/model/residuals.h"
#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet {

class Frame {
public:
    /// Brings the mesh upright, to half diameter 1 and, when lengths were read, to their scale;
    /// with azimuths of free zero it is turned until they fit best. Throws InputError.
    Frame(const Stone& stone, const std::vector<Reading>& readings);

    /// The mesh, inside.
    const Solid& solid() const { return solid_; }
    int up_facet() const { return up_facet_; }
    /// Within 10 degrees of upright in the mesh.
    bool is_girdle(int facet) const;
    /// Of the mesh, the widest in plan.
    double half_width() const;

    /// Length of the stone's unit that is 1 inside.
    double scale() const { return scale_; }
    /// By how much the mesh was made larger to suit the lengths read.
    double mesh_scale() const { return mesh_scale_; }
    /// By how much it was turned about up, to stand as the azimuths read say.
    double mesh_turn() const { return turn_; }
    /// What a quantity of a reading is multiplied by to be in the reading's unit.
    double unit_of(const Reading& reading) const;

    /// From the mesh's frame: a direction, and a point.
    Vec3 inside_direction(const Vec3& direction) const;
    /// From outlines (which were drawn beside the mesh) or a photograph (of the fitted stone, which
    /// stands straight).
    enum class From { mesh, fitted };
    glm::dmat3 turn_inside(From from) const;
    const Vec3& middle() const { return middle_; }  ///< of the mesh, in the stone's unit

    /// Turns inside positions back into the stone's unit and the mesh's pose; the rest of the
    /// motion (a free azimuth, a drift) is chosen so that the points lie nearest to the mesh's.
    struct Pose {
        double turn = 0;  ///< about up, from inside to outside: there the readings' azimuth 0 lies
        Vec3 shift{0, 0, 0};
    };
    Pose pose_of(const Shape& shape) const;
    /// The pose's turn, with its derivatives by the points; none when azimuths count from the mesh.
    Quantity turn_of(const Shape& shape) const;
    Vec3 outside_point(const Vec3& p, const Pose& pose) const;
    Plane outside_plane(const Plane& plane, const Pose& pose) const;

private:
    void bring_upright(const std::vector<Reading>& readings);
    double scale_of_readings(const std::vector<Reading>& readings, const Vec3& up) const;

    const Stone& stone_;
    Solid solid_;
    int up_facet_ = -1;
    double scale_ = 1, mesh_scale_ = 1, turn_ = 0;
    Vec3 middle_{0, 0, 0};
    glm::dmat3 upright_{1}, outward_{1};  // from the mesh's frame, and from the result's
};

}  // namespace culet
