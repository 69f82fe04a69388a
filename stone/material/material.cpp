#include "stone/material/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"

namespace culet {

namespace embedded {
extern const char* const materials_json;
}

int ray_count(OpticCharacter optic) {
    switch (optic) {
        case OpticCharacter::isotropic:
            return 1;
        case OpticCharacter::uniaxial:
            return 2;
        case OpticCharacter::biaxial:
            return 3;
    }
    return 1;
}

const char* ray_name(OpticCharacter optic, int ray) {
    static const char* const uniaxial[] = {"o", "e"};
    static const char* const biaxial[] = {"alpha", "beta", "gamma"};
    switch (optic) {
        case OpticCharacter::isotropic:
            return "n";
        case OpticCharacter::uniaxial:
            return uniaxial[ray];
        case OpticCharacter::biaxial:
            return biaxial[ray];
    }
    return "n";
}

double RefractiveIndex::at(double wavelength_nm) const {
    const double um = wavelength_nm * 1e-3;
    const double square = um * um;
    switch (form) {
        case Form::constant:
            return n;
        case Form::cauchy:
            return cauchy[0] + (cauchy[1] + cauchy[2] / square) / square;
        case Form::sellmeier: {
            double n_squared = a0 + d * square;
            for (std::size_t i = 0; i < B.size(); ++i) n_squared += B[i] * square / (square - C[i]);
            return std::sqrt(n_squared);
        }
        case Form::table:
            return table.at(wavelength_nm);
    }
    return n;
}

namespace {

using Json = nlohmann::json;

const Json& catalogue() {
    static const Json data = Json::parse(embedded::materials_json);
    return data;
}

OpticCharacter optic_of(const std::string& word) {
    if (word == "uniaxial") return OpticCharacter::uniaxial;
    if (word == "biaxial") return OpticCharacter::biaxial;
    return OpticCharacter::isotropic;
}

std::string text_of(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

RefractiveIndex index_of(const Json& ray) {
    RefractiveIndex index;
    if (ray.at("form") == "sellmeier") {
        index.form = RefractiveIndex::Form::sellmeier;
        index.a0 = ray.at("a0");
        index.d = ray.at("d");
        index.B = ray.at("B").get<std::vector<double>>();
        index.C = ray.at("C").get<std::vector<double>>();
    } else {
        index.form = RefractiveIndex::Form::cauchy;
        index.cauchy = {ray.at("A"), ray.at("B"), ray.at("C")};
    }
    return index;
}

Material pure_material(const std::string& id, const Json& entry) {
    Material material;
    material.id = id;
    material.name = text_of(entry, "name");
    material.optic = optic_of(entry.at("optic"));
    for (int ray = 0; ray < ray_count(material.optic); ++ray) {
        material.index[ray] = index_of(entry.at("rays").at(ray_name(material.optic, ray)));
    }
    if (entry.at("density_g_cm3").is_number()) material.density_g_cm3 = entry.at("density_g_cm3");
    material.valid_from_nm = 1e3 * entry.at("valid_um").at(0).get<double>();
    material.valid_to_nm = 1e3 * entry.at("valid_um").at(1).get<double>();
    material.orientation = text_of(entry, "orientation");
    material.confidence = text_of(entry, "confidence");
    material.source = text_of(entry, "source");
    material.usual_colour = text_of(entry, "usual_colour");
    return material;
}

constexpr std::size_t k_longest_query = 200, k_most_suggested = 8;

// A variety's own, else its host's.
std::string title_of(const std::string& id) {
    const auto colour = catalogue().at("absorption").find(id);
    if (colour == catalogue().at("absorption").end())
        return text_of(catalogue().at("materials").at(id), "name");
    const std::string own = text_of(*colour, "name");
    return own.empty() ? text_of(catalogue().at("materials").at(colour->at("material")), "name")
                       : own;
}

// What a search of the catalogue looks at: names, kind, colour.
std::string about(const std::string& id) {
    const Json& absorptions = catalogue().at("absorption");
    const auto colour = absorptions.find(id);
    return id + " " + title_of(id) + " " +
           (colour == absorptions.end()
                ? text_of(catalogue().at("materials").at(id), "usual_colour")
                : text_of(*colour, "material"));
}

// Empty where none or several have that title (topaz).
std::string titled(const std::string& name) {
    std::string found;
    for (const std::string& id : catalogue_names()) {
        const std::string title = title_of(id);
        if (!same_words(id, name) && !same_words(title.substr(0, title.find('(')), name)) continue;
        if (!found.empty()) return {};
        found = id;
    }
    return found;
}

}  // namespace

std::vector<std::string> catalogue_names() {
    std::vector<std::string> names;
    for (const auto& [id, entry] : catalogue().at("materials").items()) names.push_back(id);
    for (const auto& [id, entry] : catalogue().at("absorption").items()) {
        if (std::find(names.begin(), names.end(), id) == names.end()) names.push_back(id);
    }
    return names;
}

Material catalogue_material(const std::string& name) {
    const Json& materials = catalogue().at("materials");
    const Json& absorptions = catalogue().at("absorption");
    const auto colour = absorptions.find(name);
    const auto plain = materials.find(name);
    if (plain != materials.end() && colour == absorptions.end()) return pure_material(name, *plain);
    if (colour != absorptions.end()) {
        // A coloured variety has the host's indices and the absorption of one stone of its kind. A
        // name of both (emerald, peridot) means the coloured stone, which people own.
        const std::string host = colour->at("material");
        Material material = pure_material(host, materials.at(host));
        material.id = name;
        material.name = title_of(name);
        material.absorption_source = text_of(*colour, "source");
        material.absorption_confidence = text_of(*colour, "confidence");
        material.absorption_depth = text_of(*colour, "scale_reason");
        material.usual_colour.clear();
        // Colour depth relative to the measured stone.
        const double depth = colour->value("scale", 1.0);
        const auto nm = colour->at("wavelength_nm").get<std::vector<double>>();
        const Json& rays = colour->at("rays");
        bool coloured = false;
        for (int ray = 0; ray < ray_count(material.optic); ++ray) {
            const auto found = rays.find(ray_name(material.optic, ray));
            if (found == rays.end()) continue;
            coloured = true;
            // The catalogue's unit is 1/cm.
            material.absorption_per_mm[ray] =
                Spectrum(nm, found->get<std::vector<double>>()).scaled(0.1 * depth);
        }
        if (!coloured)
            throw InternalError(fmt::format(
                "{} of the catalogue absorbs along none of the rays of {}", name, host));
        return material;
    }
    const std::string meant = name.size() > k_longest_query ? std::string() : titled(name);
    if (!meant.empty()) return catalogue_material(meant);
    // Prefer names with the word itself to those with it inside another (beryl, chrysoberyl).
    std::vector<std::string> like = catalogue_names_like(name);
    const auto others = std::stable_partition(
        like.begin(), like.end(),
        [&name](const std::string& id) { return holds_whole_words(about(id), name); });
    if (others != like.begin()) like.erase(others, like.end());
    throw InputError(fmt::format(
        "no material \"{}\" in the catalogue{}; culet info --materials WORD looks for one, or "
        "describe yours in a [material] table",
        name,
        like.empty() ? std::string()
                     : fmt::format(" (did you mean {}?)", listed(like, k_most_suggested))));
}

std::vector<std::string> catalogue_names_like(const std::string& words) {
    const std::vector<std::string> names = catalogue_names();
    std::vector<std::string> found;
    if (words.size() > k_longest_query) return found;
    for (const std::string& name : names) {
        if (holds_words(about(name), words)) found.push_back(name);
    }
    if (found.empty()) return names_like(words, names);
    std::stable_partition(found.begin(), found.end(),
                          [&words](const std::string& id) { return holds_words(id, words); });
    return found;
}

bool Material::has_absorption() const {
    for (int ray = 0; ray < ray_count(optic); ++ray) {
        if (absorption_per_mm[ray].max() > 0) return true;
    }
    return false;
}

std::vector<std::string> notes_on(const Material& material) {
    std::vector<std::string> notes = material.notes;
    if (material.usual_colour.empty() || material.has_absorption()) return notes;
    notes.push_back(fmt::format(
        "{} is drawn without colour: stones of that name are {}, but the catalogue has no "
        "absorption spectrum of them (give one with absorption in a [material] table)",
        material.id, material.usual_colour));
    return notes;
}

}  // namespace culet
