#pragma once
// What a stone is made of: density, and refractive index and absorption of each principal ray.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "stone/material/spectrum.h"

namespace culet {

/// Refractive index of one principal ray as a function of wavelength.
struct RefractiveIndex {
    enum class Form { constant, cauchy, sellmeier, table };
    Form form = Form::constant;
    double n = 1.5;                  ///< constant
    std::array<double, 3> cauchy{};  ///< n = A + B/L^2 + C/L^4, L in micrometres
    /// n^2 = a0 + sum_i B_i L^2/(L^2 - C_i) + d L^2, L in micrometres, C_i in micrometres squared
    double a0 = 1, d = 0;
    std::vector<double> B, C;
    Spectrum table;  ///< n by nm

    double at(double wavelength_nm) const;
    bool is_constant() const { return form == Form::constant; }
};

enum class OpticCharacter { isotropic, uniaxial, biaxial };

/// Number of principal rays: 1 (n), 2 (o, e) or 3 (alpha, beta, gamma; index increasing).
int ray_count(OpticCharacter optic);
/// `n`; `o`, `e`; `alpha`, `beta`, `gamma`.
const char* ray_name(OpticCharacter optic, int ray);

struct Material {
    std::string id = "glass";
    std::string name;  ///< title; a variety's own (`Ruby`)
    OpticCharacter optic = OpticCharacter::isotropic;
    std::array<RefractiveIndex, 3> index;  ///< the first ray_count(optic) are used
    /// Napierian intensity coefficient per mm along the ray, for E along each principal axis.
    std::array<Spectrum, 3> absorption_per_mm;
    /// Set when an absorption was given as three numbers for R, G, B (Guy & Soler 2004, table 6.1):
    /// the spectrum above is then those numbers at 610, 545 and 465 nm.
    bool absorption_from_rgb = false;
    std::optional<double> density_g_cm3;
    double valid_from_nm = 380, valid_to_nm = 780;
    std::string orientation, confidence, source, absorption_source;
    std::string absorption_confidence;  ///< measured, or a model, and how sure
    std::string absorption_depth;       ///< why the catalogue's spectrum is not that of its source
    /// Colour of most stones of that name, where no spectrum of them is at hand; else empty.
    std::string usual_colour;
    std::vector<std::string> notes;  ///< what was taken for granted on reading its tables

    /// False: it is drawn without colour, for want of a spectrum or because it has none.
    bool has_absorption() const;
};

/// Names of the catalogue: materials, then coloured varieties (`ruby_pale` is `corundum` with an
/// absorption), in order.
std::vector<std::string> catalogue_names();

/// A material or coloured variety of the catalogue, by its name there or by its title up to a
/// parenthesis where only one is called so (`ruby` is ruby_gem, `blue sapphire` sapphire_blue).
/// Throws InputError with the nearest names when there is none of that name.
Material catalogue_material(const std::string& name);

/// Names whose material has all of `words` in its name, its kind or its usual colour (`blue
/// sapphire`, `tsavorite`), those named so first; else those nearest by spelling; perhaps none.
std::vector<std::string> catalogue_names_like(const std::string& words);

/// The material's notes, and a sentence on the colour that is missing when stones of that name are
/// coloured and the catalogue has no spectrum of them.
std::vector<std::string> notes_on(const Material& material);

}  // namespace culet
