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
    /// The absorption was given as three numbers for R, G, B (Guy & Soler 2004, table 6.1): the
    /// spectrum above has them at 610, 545 and 465 nm.
    bool absorption_from_rgb = false;
    std::optional<double> density_g_cm3;
    double valid_from_nm = 380, valid_to_nm = 780;
    std::string orientation, confidence, source, absorption_source;
    std::string absorption_confidence;  ///< measured, or a model, and how sure
    std::string absorption_depth;       ///< why the catalogue's spectrum is not that of its source
    /// Colour of most stones of that name, where no spectrum of them is at hand; else empty.
    std::string usual_colour;
    std::vector<std::string> notes;  ///< what was taken for granted on reading its tables

    /// False: drawn without colour, because there is no spectrum or no absorption.
    bool has_absorption() const;
};

/// Lists materials, then coloured varieties (`ruby_pale` is `corundum` with an absorption).
std::vector<std::string> catalogue_names();

/// Finds a material by name, or by title up to a parenthesis if that is unique (`ruby` is ruby_gem,
/// `blue sapphire` sapphire_blue). Throws InputError with the nearest names.
Material catalogue_material(const std::string& name);

/// Names whose material has all of `words` in its name, kind or usual colour (`blue sapphire`,
/// `tsavorite`), matching names first; else those nearest by spelling, if any.
std::vector<std::string> catalogue_names_like(const std::string& words);

/// The material's notes, and a sentence if stones of that name are coloured but the catalogue has
/// no spectrum.
std::vector<std::string> notes_on(const Material& material);

}  // namespace culet
