// Compares the catalogue's stones with published colours: bench_stone_colours
//
// Prints the body colour (render/colour/material_colour.h) at 6.5 mm, and the mean of a round
// brilliant of 6.5 mm face up in white light from everywhere, which is what a spectrophotometer
// with a sphere measures on a cut stone. So measured, natural rubies have L* 32 to 44, a* 6 to 27,
// b* -5 to 4 in D65 (Influence of Light Source and Cathodoluminescence on the Color Parameters of
// Ruby Red, Key Eng. Mater. 492, 379, 2011, abstract).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/colour/material_colour.h"
#include "render/render.h"
#include "stone/cuts/cuts.h"
#include "tests/render/published_gem_colours.h"

namespace culet {
namespace {

double hue_deg(const Lab& c) {
    const double h = std::atan2(c.b, c.a) * 180 / std::numbers::pi;
    return h < 0 ? h + 360 : h;
}

double hue_distance(const Lab& x, const Lab& y) {
    const double d = std::abs(hue_deg(x) - hue_deg(y));
    return std::min(d, 360 - d);
}

// Mean radiance inside the outline of a brilliant of 6.5 mm, seen face up in a light of 1 from
// everywhere.
Rgb face_up(const Material& material) {
    Scene scene;
    scene.stone.solid = make_cut("round-brilliant", {{"diameter", k_usual_width_mm}});
    scene.stone.material = material;
    scene.camera.orthographic_width = k_usual_width_mm;
    scene.camera.width = scene.camera.height = 48;
    scene.lights.constant = 1;
    scene.settings.tolerance = 0.02;
    const Picture picture = render(scene).picture;
    Rgb sum{};
    int count = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const double r =
                std::hypot(x + 0.5 - picture.width / 2.0, y + 0.5 - picture.height / 2.0);
            if (r > 0.48 * picture.width) continue;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += picture.pixel(x, y)[c];
            ++count;
        }
    }
    for (double& value : sum) value /= count;
    return sum;
}

void print_mean_path() {
    fmt::print(
        "mean way of faintly absorbed light through a brilliant of 6.5 mm, face up in light "
        "from all sides (of body colours: {:.2f} mm)\n",
        light_path_mm(k_usual_width_mm));
    for (const char* name : {"quartz", "corundum", "spinel", "garnet_almandine", "diamond"}) {
        Material material = catalogue_material(name);
        // Weak and grey: the loss is this times the path length.
        constexpr double k_per_mm = 1e-3;
        for (Spectrum& spectrum : material.absorption_per_mm) spectrum = Spectrum(k_per_mm);
        const double n = material.index[0].at(550), r = std::pow((n - 1) / (n + 1), 2);
        const double lost = 1 - luminance(face_up(material));
        fmt::print("  {:<18} {:.2f} mm of all light, {:.2f} mm of what enters\n", name,
                   lost / k_per_mm, lost / k_per_mm / (1 - r));
    }
}

void print_colours() {
    fmt::print("\n{:<19} {:>22}  {:>22}  {:>6} {:>6} {:>6}  {}\n", "stone", "body L* a* b*",
               "face up L* a* b*", "hue", "L*", "dE00", "body colour, and the nearest published");
    for (const std::string& name : catalogue_names()) {
        const Material material = catalogue_material(name);
        if (!material.has_absorption()) continue;
        const StoneColour body = body_colour(material);
        const Rgb mean = face_up(material);
        const Lab seen = lab_from_linear_srgb(mean[0], mean[1], mean[2]);
        std::string judged = fmt::format("{:>6} {:>6} {:>6}", "", "", ""), nearest;
        for (const test::NamedGem& gem : test::named_gems()) {
            if (gem.material != name) continue;
            double least = 1e9;
            for (const test::PublishedColour& published : gem.colours) {
                const Lab lab = test::lab_of_srgb(published.srgb);
                const double difference = ciede2000(body.lab, lab);
                if (difference >= least) continue;
                least = difference;
                judged = fmt::format("{:>6.0f} {:>6.0f} {:>6.1f}", hue_distance(body.lab, lab),
                                     body.lab.L - lab.L, difference);
                nearest = fmt::format("; {} ({})", published.word, colour_name(lab));
            }
        }
        fmt::print("{:<19} {:>6.1f} {:>7.1f} {:>7.1f}  {:>6.1f} {:>7.1f} {:>7.1f}  {}  {}{}\n",
                   name, body.lab.L, body.lab.a, body.lab.b, seen.L, seen.a, seen.b, judged,
                   body.name, nearest);
    }
}

}  // namespace
}  // namespace culet

int main() {
    culet::print_mean_path();
    culet::print_colours();
    return 0;
}
