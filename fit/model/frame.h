#pragma once
// The frame of the fit ("inside"): the mesh upright, its middle at the origin, half diameter 1; and
// the transformation back to the mesh's own frame ("outside").

#include <vector>

#include "fit/model/residuals.h"
#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet {

class Frame {
public:
    /// Brings the mesh upright, scales it to half diameter 1 and, when lengths were read, to their
    /// scale. When azimuths have a free zero, turns it to where they fit best. Throws InputError.
    Frame(const Stone& stone, const std::vector<Reading>& readings);

    /// The mesh, inside.
    const Solid& solid() const { return solid_; }
    int up_facet() const { return up_facet_; }
    /// Within 10 degrees of upright in the mesh.
    bool is_girdle(int facet) const;
    /// Half the mesh's greatest width in plan.
    double half_width() const;

    /// The stone's unit per unit inside.
    double scale() const { return scale_; }
    /// Factor by which the mesh was enlarged to match the lengths read.
    double mesh_scale() const { return mesh_scale_; }
    /// Turn of the mesh about up, in radians, to match the azimuths read.
    double mesh_turn() const { return turn_; }
    /// Factor from a quantity inside to the reading's unit.
    double unit_of(const Reading& reading) const;

    /// Turns a direction from the mesh's frame.
    Vec3 inside_direction(const Vec3& direction) const;
    /// Outlines are given in the mesh's frame, a photograph in that of the fitted stone, whose up
    /// is exactly along an axis.
    enum class From { mesh, fitted };
    glm::dmat3 turn_inside(From from) const;
    const Vec3& middle() const { return middle_; }  ///< of the mesh, in the stone's unit

    /// Motion from inside to the stone's unit and the mesh's pose. What the readings leave free of
    /// it (azimuth, drift) brings the points nearest to the mesh's.
    struct Pose {
        double turn = 0;  ///< about up, from inside to outside: where the readings' azimuth 0 lies
        Vec3 shift{0, 0, 0};
    };
    Pose pose_of(const Shape& shape) const;
    /// The pose's turn with its derivatives by the points; zero when azimuths count from the mesh.
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
