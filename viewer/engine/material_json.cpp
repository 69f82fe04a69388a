// Materials as JSON.

#include "stone/text/errors.h"
#include "viewer/engine/stone_json.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* k_forms[] = {"constant", "cauchy", "sellmeier", "table"};
constexpr const char* k_optics[] = {"isotropic", "uniaxial", "biaxial"};

template <std::size_t N>
std::size_t place_of(const std::string& word, const char* const (&words)[N]) {
    for (std::size_t i = 0; i < N; ++i) {
        if (word == words[i]) return i;
    }
    throw InputError("the page's document has an unknown word: \"" + word + "\"");
}

Json spectrum_json(const Spectrum& spectrum) {
    return {{"nm", spectrum.wavelengths_nm()}, {"values", spectrum.values()}};
}

Spectrum spectrum_from(const Json& json) {
    auto nm = json.at("nm").get<std::vector<double>>();
    auto values = json.at("values").get<std::vector<double>>();
    if (nm.empty() && values.size() == 1) return Spectrum(values.front());
    if (nm.size() != values.size() || nm.empty())
        throw InputError("the page's document has a spectrum without an end");
    for (std::size_t i = 1; i < nm.size(); ++i) {
        if (!(nm[i] > nm[i - 1]))
            throw InputError("the page's document has a spectrum whose wavelengths do not rise");
    }
    return {std::move(nm), std::move(values)};
}

Json index_json(const RefractiveIndex& index) {
    return {{"form", k_forms[static_cast<std::size_t>(index.form)]},
            {"n", index.n},
            {"cauchy", index.cauchy},
            {"a0", index.a0},
            {"d", index.d},
            {"B", index.B},
            {"C", index.C},
            {"table", spectrum_json(index.table)}};
}

RefractiveIndex index_from(const Json& json) {
    RefractiveIndex index;
    index.form =
        static_cast<RefractiveIndex::Form>(place_of(json.at("form").get<std::string>(), k_forms));
    index.n = json.at("n");
    index.cauchy = json.at("cauchy").get<std::array<double, 3>>();
    index.a0 = json.at("a0");
    index.d = json.at("d");
    index.B = json.at("B").get<std::vector<double>>();
    index.C = json.at("C").get<std::vector<double>>();
    index.table = spectrum_from(json.at("table"));
    return index;
}

}  // namespace

Json json_of(const Material& material) {
    Json index = Json::array(), absorption = Json::array();
    for (int ray = 0; ray < ray_count(material.optic); ++ray) {
        index.push_back(index_json(material.index[static_cast<std::size_t>(ray)]));
        absorption.push_back(
            spectrum_json(material.absorption_per_mm[static_cast<std::size_t>(ray)]));
    }
    Json json{{"id", material.id},
              {"name", material.name},
              {"optic", k_optics[static_cast<std::size_t>(material.optic)]},
              {"index", index},
              {"absorption_per_mm", absorption},
              {"absorption_from_rgb", material.absorption_from_rgb},
              {"valid_nm", {material.valid_from_nm, material.valid_to_nm}},
              {"usual_colour", material.usual_colour}};
    if (material.density_g_cm3) json["density_g_cm3"] = *material.density_g_cm3;
    return json;
}

Material material_from(const Json& json) {
    Material material;
    material.id = json.at("id");
    material.name = json.at("name");
    material.optic =
        static_cast<OpticCharacter>(place_of(json.at("optic").get<std::string>(), k_optics));
    for (int ray = 0; ray < ray_count(material.optic); ++ray) {
        const auto at = static_cast<std::size_t>(ray);
        material.index[at] = index_from(json.at("index").at(at));
        material.absorption_per_mm[at] = spectrum_from(json.at("absorption_per_mm").at(at));
    }
    material.absorption_from_rgb = json.at("absorption_from_rgb");
    material.valid_from_nm = json.at("valid_nm").at(0);
    material.valid_to_nm = json.at("valid_nm").at(1);
    material.usual_colour = json.at("usual_colour");
    if (json.contains("density_g_cm3")) material.density_g_cm3 = json.at("density_g_cm3");
    return material;
}

}  // namespace culet
