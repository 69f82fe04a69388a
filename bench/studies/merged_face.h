#pragma once
// A face of a uniaxial crystal, compared with one whose two waves are merged (Guy & Soler 2004, 4.2
// and fig. 4): one index, the mean, and Fresnel's coefficients of an isotropic face.

#include <array>

#include "stone/solid/solid.h"

namespace culet {

/// Powers at a face where light enters from air. For light polarised s and p: what goes into the
/// ordinary and the extraordinary wave, and what is reflected as s and p.
struct FacePowers {
    static constexpr std::array<const char*, 8> names{
        "s into o",         "s into e",         "p into o",         "p into e",
        "s reflected as s", "s reflected as p", "p reflected as s", "p reflected as p"};
    std::array<double, 8> power{};
};

/// `axis`: unit, in the frame of the face: z points into the crystal, and x z is the plane of
/// incidence.
FacePowers exact_face(double n_o, double n_e, const Vec3& axis, double incidence);

/// The same with merged waves: s and p enter as through glass. They are then split according to the
/// angle between their vibrations and those of the two waves along the single ray.
FacePowers merged_face(double n_o, double n_e, const Vec3& axis, double incidence);

/// Takes the largest of the eight, over incidences to 90 degrees in `steps` steps.
double largest_face_difference(double n_o, double n_e, const Vec3& axis, int steps);

}  // namespace culet
