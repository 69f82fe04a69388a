#include "render/colour/material_colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "stone/text/errors.h"

namespace culet {

namespace embedded {
extern const char* const iscc_nbs_csv;
}

namespace {

struct NamedColour {
    std::string name;
    Lab lab;
};

const std::vector<NamedColour>& named_colours() {
    static const std::vector<NamedColour> all = [] {
        std::vector<NamedColour> colours;
        std::istringstream lines{std::string(embedded::iscc_nbs_csv)};
        bool header_seen = false;
        for (std::string line; std::getline(lines, line);) {
            if (line.empty() || line[0] == '#') continue;
            if (!header_seen) {
                header_seen = true;
                continue;
            }
            const std::size_t comma = line.find(',');
            const std::string hex = line.substr(comma + 1);
            check(hex.size() == 6, "a named colour has six digits");
            Rgb rgb{};
            for (std::size_t i = 0; i < 3; ++i) {
                int value = 0;
                std::from_chars(hex.data() + 2 * i, hex.data() + 2 * i + 2, value, 16);
                rgb[i] = srgb_decoded(value / 255.0);
            }
            colours.push_back(
                {line.substr(0, comma), lab_from_linear_srgb(rgb[0], rgb[1], rgb[2])});
        }
        return colours;
    }();
    return all;
}

// 5 nm is the finest step of the catalogue's spectra, so sums are exact for them.
const WavelengthSet& visible() {
    static const WavelengthSet set = [] {
        std::vector<double> nm;
        for (int i = 380; i <= 780; i += 5) nm.push_back(i);
        return WavelengthSet(nm);
    }();
    return set;
}

}  // namespace

double light_path_mm(double width_mm) {
    constexpr double k_depth_of_width = 0.61, k_ways_of_depth = 2.2;
    return k_ways_of_depth * k_depth_of_width * width_mm;
}

StoneColour body_colour(const Material& material, double width_mm) {
    StoneColour colour;
    colour.name = "colourless";
    if (!material.has_absorption()) return colour;
    const double path = light_path_mm(width_mm);
    const int rays = ray_count(material.optic);
    std::vector<double> light;
    for (const double nm : visible().wavelengths_nm()) {
        double sum = 0;
        for (int ray = 0; ray < rays; ++ray)
            sum += std::exp(-path * material.absorption_per_mm[ray].at(nm));
        light.push_back(sum / rays);
    }
    colour.rgb = visible().rgb_of(light.data());
    colour.lab = lab_from_linear_srgb(colour.rgb[0], colour.rgb[1], colour.rgb[2]);
    // Colours not distinguishable from colourless get no colour name (2.3 is just noticeable: M.
    // Mahy et al., Color Res. Appl. 19, 105, 1994).
    if (ciede2000(colour.lab, Lab{100, 0, 0}) > 2.3) colour.name = colour_name(colour.lab);
    return colour;
}

std::string colour_name(const Lab& colour) {
    double least = std::numeric_limits<double>::infinity();
    std::string name;
    for (const NamedColour& named : named_colours()) {
        const double difference = ciede2000(colour, named.lab);
        if (difference < least) {
            least = difference;
            name = named.name;
        }
    }
    return name;
}

std::array<int, 3> display_colour(const Rgb& linear) {
    std::array<int, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double encoded = srgb_encoded(std::clamp(linear[i], 0.0, 1.0));
        values[i] = static_cast<int>(std::lround(255 * encoded));
    }
    return values;
}

std::string display_hex(const Rgb& linear) {
    const auto [red, green, blue] = display_colour(linear);
    return fmt::format("#{:02x}{:02x}{:02x}", red, green, blue);
}

}  // namespace culet
