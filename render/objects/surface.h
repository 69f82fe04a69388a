#pragma once
// What a surface does to light: the materials of objects, made ready for one set of wavelengths.

#include <array>
#include <vector>

#include "render/colour/colour.h"
#include "render/optics/random.h"
#include "render/scene/objects.h"

namespace culet {

enum class SurfaceKind { diffuse, rough_metal, metal, mirror, dielectric, emitter };

/// Of light that a polished surface reflects, at one wavelength: what becomes of the Stokes
/// parameters that count from the plane of incidence (s: +S1; Born & Wolf, 1.5 and 14.4).
struct MuellerReflection {
    double mean = 1;         ///< (R_s + R_p) / 2
    double difference = 0;   ///< (R_s - R_p) / 2
    double re = -1, im = 0;  ///< of r_s conj(r_p)
};

class ReadySurface {
public:
    /// `outside`: the refractive index around it.
    ReadySurface(const SurfaceMaterial& material, const WavelengthSet& wavelengths, double outside);

    SurfaceKind kind = SurfaceKind::diffuse;
    std::vector<double> colour;  ///< at each node: albedo, or an emitter's radiance
    double index = 1;            ///< of glass over that around it
    std::vector<double> absorption;
    double alpha = 0;  ///< of microfacets

    /// Of a metal at a node, for the cosine of incidence.
    MuellerReflection reflection(int node, double cosine) const;
    /// Mean of s and p, of a metal.
    double reflectance(int node, double cosine) const;
    /// Of microfacets that reflect all, what leaves them after one reflection; the rest meets more.
    double reflected_once(double cosine) const;
    /// What a rough surface sends out more than light that is reflected `once`, because what meets
    /// several microfacets is not lost (Turquin 2019, after Kulla & Conty 2017).
    double gain(int node, double once) const {
        return 1 + normal_reflectance_[static_cast<std::size_t>(node)] * (1 - once) / once;
    }

private:
    void prepare_reflected_once();
    std::vector<double> n_, k_, normal_reflectance_;
    std::vector<double> reflected_once_;  ///< by the cosine
};

/// Microfacets of Trowbridge & Reitz (GGX), with Smith's height-correlated shadowing (Heitz 2014).
/// Directions in the surface's frame, unit, z along the normal, both away from the surface.
namespace ggx {
double density(double alpha, const Vec3& half);
/// Share of microfacets of that direction that are seen from it.
double masking(double alpha, const Vec3& direction);
double masking_and_shadowing(double alpha, const Vec3& a, const Vec3& b);
/// A visible normal's reflection of `from` (Dupuy & Benyoub 2023); z may be below 0.
Vec3 sample(double alpha, const Vec3& from, double u, double v);
/// Its density per solid angle.
double sample_density(double alpha, const Vec3& from, const Vec3& to);
}  // namespace ggx

}  // namespace culet
