#include "bench/studies/merged_face.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/optics/crystal.h"
#include "render/optics/fresnel.h"

namespace culet {

FacePowers exact_face(double n_o, double n_e, const Vec3& axis, double incidence) {
    const CrystalEntry entry =
        enter_crystal(uniaxial_crystal(axis, n_o, n_e), 1, {std::sin(incidence), 0, 0}, {0, 0, 1});
    FacePowers face;
    for (std::size_t in = 0; in < 2; ++in)
        for (std::size_t out = 0; out < 2; ++out) {
            face.power[2 * in + out] = entry.power[in][out];
            face.power[4 + 2 * in + out] = std::norm(entry.back[in][out]);
        }
    return face;
}

FacePowers merged_face(double n_o, double n_e, const Vec3& axis, double incidence) {
    const double n = 0.5 * (n_o + n_e), k = std::sin(incidence);
    const FaceAmplitudes glass = fresnel(1, n, std::cos(incidence));
    const Vec3 wave{k / n, 0, std::sqrt((1 - k / n) * (1 + k / n))}, s{0, -1, 0};
    // The ordinary wave vibrates perpendicular to the axis and the wave normal.
    const Vec3 across = glm::cross(axis, wave);
    const double length = glm::length(across),
                 o_along_s = length > 0 ? glm::dot(across, s) / length : 1,
                 o_share_of_s = o_along_s * o_along_s;
    FacePowers face;
    const double T_s = glass.t_s * glass.t_s, T_p = glass.t_p * glass.t_p;
    face.power = {T_s * o_share_of_s,
                  T_s * (1 - o_share_of_s),
                  T_p * (1 - o_share_of_s),
                  T_p * o_share_of_s,
                  std::norm(glass.r_s),
                  0,
                  0,
                  std::norm(glass.r_p)};
    return face;
}

double largest_face_difference(double n_o, double n_e, const Vec3& axis, int steps) {
    double largest = 0;
    for (int i = 0; i <= steps; ++i) {
        const double incidence = 0.5 * std::numbers::pi * i / steps;
        const FacePowers exact = exact_face(n_o, n_e, axis, incidence),
                         merged = merged_face(n_o, n_e, axis, incidence);
        for (std::size_t j = 0; j < exact.power.size(); ++j)
            largest = std::max(largest, std::abs(exact.power[j] - merged.power[j]));
    }
    return largest;
}

}  // namespace culet
