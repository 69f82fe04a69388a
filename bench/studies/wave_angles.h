#pragma once
// The largest angle between the two rays into which a ray splits on entering a uniaxial crystal
// from air (Guy & Soler 2004, table of section 4.2).

#include "stone/solid/solid.h"

namespace culet {

struct WaveAngle {
    double angle = 0;      ///< between the ordinary and the extraordinary ray, radians
    double incidence = 0;  ///< of the light in air, radians
    Vec3 axis{0, 0, 1};    ///< optic axis; the face's normal is z, the plane of incidence x z
    /// At the same place: the angle from the ray of the mean index, which replaces both when they
    /// are merged, to the farther of the two.
    double from_merged = 0;
};

/// Maximum over all incidences and directions of the optic axis. The indices must be above 1.
WaveAngle largest_wave_angle(double n_o, double n_e);

/// The same to first order in n_e - n_o. The maximum is at grazing incidence with the axis in the
/// plane of incidence: (n_e - n_o) / n x (t + sqrt(4 + t^2)) / 2. Here t = 1 / sqrt(n^2 - 1) is the
/// tangent of the angle of refraction and n the mean index.
double first_order_wave_angle(double n_o, double n_e);

}  // namespace culet
