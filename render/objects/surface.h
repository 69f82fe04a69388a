#pragma once
// Reflection by objects' materials, prepared for one set of wavelengths.

#include <array>
#include <vector>

#include "render/colour/colour.h"
#include "render/optics/random.h"
#include "render/scene/objects.h"

namespace culet {

enum class SurfaceKind { diffuse, rough_metal, metal, mirror, dielectric, emitter };

/// Reflection by a polished surface at one wavelength, for Stokes parameters relative to the plane
/// of incidence (s: +S1; Born & Wolf, 1.5 and 14.4).
struct MuellerReflection {
    double mean = 1;         ///< (R_s + R_p) / 2
    double difference = 0;   ///< (R_s - R_p) / 2
    double re = -1, im = 0;  ///< of r_s conj(r_p)
};

class ReadySurface {
public:
    /// `outside`: refractive index of the surroundings.
    ReadySurface(const SurfaceMaterial& material, const WavelengthSet& wavelengths, double outside);

    SurfaceKind kind = SurfaceKind::diffuse;
    std::vector<double> colour;  ///< at each node: albedo, or an emitter's radiance
    double index = 1;            ///< of glass, relative to the outside
    std::vector<double> absorption;
    double alpha = 0;  ///< roughness of the microfacets

    /// Of a metal at a node, for the cosine of incidence.
    MuellerReflection reflection(int node, double cosine) const;
    /// Mean of s and p, of a metal.
    double reflectance(int node, double cosine) const;
    /// Part of the light that lossless microfacets send out after one reflection; the rest is
    /// reflected again.
    double reflected_once(double cosine) const;
    /// Factor on singly reflected light that restores multiple reflections between microfacets
    /// (Turquin 2019, after Kulla & Conty 2017). `once`: reflected_once.
    double gain(int node, double once) const {
        return 1 + normal_reflectance_[static_cast<std::size_t>(node)] * (1 - once) / once;
    }

private:
    void prepare_reflected_once();
    std::vector<double> n_, k_, normal_reflectance_;
    std::vector<double> reflected_once_;  ///< by cosine
};

/// Trowbridge-Reitz microfacets (GGX) with Smith's height-correlated shadowing (Heitz 2014).
/// Directions are unit, point away from the surface, and are in its frame (z along the normal).
namespace ggx {
double density(double alpha, const Vec3& half);
/// Part of the microfacets facing a direction that are visible from it.
double masking(double alpha, const Vec3& direction);
double masking_and_shadowing(double alpha, const Vec3& a, const Vec3& b);
/// Reflects `from` at a random visible normal (Dupuy & Benyoub 2023); the result's z may be below
/// 0.
Vec3 sample(double alpha, const Vec3& from, double u, double v);
/// Density of `sample` per solid angle.
double sample_density(double alpha, const Vec3& from, const Vec3& to);
}  // namespace ggx

}  // namespace culet
