// Makes the sample `dravite-step`: a hidden true stone, the hand-made mesh that a modeller would
// have drawn of it, the readings that instruments would give, and what a camera would do to its
// picture.
//   make_dravite_step stone FOLDER             truth.asc, hand.obj, readings.csv
//   make_dravite_step photograph TRUE.exr OUT.png
// Everything random comes from the seeds below, so the sample can be made again to the bit.

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <array>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "stone/gemcad/gemcad_io.h"
#include "stone/solid/half_edges.h"
#include "stone/stone.h"

namespace {

using namespace culet;

// Normal deviates by Box and Muller (1958): the standard library's own differ between versions.
class Deviates {
public:
    explicit Deviates(std::uint64_t seed) : engine_(seed) {}
    double normal(double sigma) {
        const double u = 1.0 - uniform(), v = uniform();
        return sigma * std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
    }

private:
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    std::mt19937_64 engine_;
};

struct Side {
    const char* name;
    double azimuth_deg;
    double girdle_mm;  // distance of the girdle facet from the axis
};

struct Tier {
    const char* name;
    double angle_deg;
    double start_mm;  // height at which the tier begins, counted away from the girdle
};

struct Proportions {
    std::array<Side, 8> sides;
    std::array<Tier, 3> crown, pavilion;
    double table_mm, half_girdle_mm;
};

Proportions step_cut() {
    const double end = 4.5, side = 3.5, corner = 4.85;
    return {{{{"E", 0, end},
              {"NE", 45, corner},
              {"N", 90, side},
              {"NW", 135, corner},
              {"W", 180, end},
              {"SW", 225, corner},
              {"S", 270, side},
              {"SE", 315, corner}}},
            {{{"C1", 48, 0.10}, {"C2", 38, 0.55}, {"C3", 27, 0.95}}},
            {{{"P1", 60, 0.10}, {"P2", 49, 1.35}, {"P3", 40, 2.25}}},
            1.25,
            0.10};
}

Vec3 direction(double azimuth, double inclination, bool crown) {
    return {std::sin(inclination) * std::cos(azimuth), std::sin(inclination) * std::sin(azimuth),
            (crown ? 1 : -1) * std::cos(inclination)};
}

// Planes of a step cut: every tier of a side starts where the tier before it has come to.
std::vector<NamedPlane> planes_of(const Proportions& cut, double tilt_deg, double shift_mm,
                                  Deviates& deviates) {
    std::vector<NamedPlane> planes;
    const auto add = [&](const std::string& name, double azimuth_deg, double angle_deg, bool crown,
                         double radius, double height) {
        const double a = radians(azimuth_deg), i = radians(angle_deg);
        const Vec3 on{radius * std::cos(a), radius * std::sin(a), height};
        const double sin_i = std::max(std::sin(i), 1e-3);
        const Vec3 n = direction(a + deviates.normal(radians(tilt_deg)) / sin_i,
                                 i + deviates.normal(radians(tilt_deg)), crown);
        planes.push_back({name, {n, glm::dot(n, on) + deviates.normal(shift_mm)}});
    };
    planes.push_back({"T", {{0, 0, 1}, cut.table_mm}});
    for (const bool crown : {true, false}) {
        const auto& tiers = crown ? cut.crown : cut.pavilion;
        for (std::size_t t = 0; t < tiers.size(); ++t) {
            for (const Side& side : cut.sides) {
                double radius = side.girdle_mm, height = cut.half_girdle_mm;
                for (std::size_t below = 0; below < t; ++below) {
                    radius -= (tiers[below + 1].start_mm - height) /
                              std::tan(radians(tiers[below].angle_deg));
                    height = tiers[below + 1].start_mm;
                }
                // Tilted about the middle of its upper edge, as a facet is cut: deeper on one side.
                add(fmt::format("{}{}", tiers[t].name, side.name), side.azimuth_deg,
                    tiers[t].angle_deg, crown, radius, crown ? height : -height);
            }
        }
    }
    for (const Side& side : cut.sides) {
        add(fmt::format("G{}", side.name), side.azimuth_deg, 90, true, side.girdle_mm, 0);
    }
    return planes;
}

// What the modeller drew: the right facets, wrong proportions (2 to 5 %), corners placed by eye.
Solid hand_mesh() {
    Deviates none(0), hand(1904);
    Proportions cut = step_cut();
    for (Tier& tier : cut.crown) tier.angle_deg += 1.5;
    for (Tier& tier : cut.pavilion) tier.angle_deg -= 1.0;
    const auto planes = planes_of(cut, 0, 0, none);
    Solid solid = contract_near_meets(intersect_half_spaces(planes).solid, 1e-6).solid;
    for (Vec3& v : solid.vertices) {
        v *= Vec3{1.04, 0.97, 1.05};
        v += Vec3{hand.normal(0.05), hand.normal(0.05), hand.normal(0.04)};
        for (int axis = 0; axis < 3; ++axis) v[axis] = std::round(v[axis] * 100) / 100;
    }
    for (Facet& facet : solid.facets) {
        std::vector<Vec3> loop;
        for (int corner : facet.corners) loop.push_back(solid.vertices[corner]);
        facet.plane = plane_through(loop);
    }
    return solid;
}

Solid true_stone() {
    Deviates cutter(1829);
    const auto planes = planes_of(step_cut(), 0.15, 0.008, cutter);
    return intersect_half_spaces(planes).solid;
}

double rounded(double value, double step) {
    return std::round(value / step) * step;
}

void write_readings(const Solid& truth, const std::filesystem::path& file) {
    Deviates instrument(2004);
    std::ofstream out(file);
    out << "kind,of,value,sigma\n";
    for (const Facet& facet : truth.facets) {
        if (facet.name == "T") continue;
        const double i =
            degrees(inclination(facet.plane.normal, {0, 0, 1})) + instrument.normal(0.1);
        fmt::print(out, "inclination,{},{:.1f},0.1\n", facet.name, std::min(90.0, rounded(i, 0.1)));
    }
    for (const Facet& facet : truth.facets) {
        if (facet.name == "T") continue;
        const double i = inclination(facet.plane.normal, {0, 0, 1});
        const double a =
            degrees(azimuth(facet.plane.normal)) + instrument.normal(0.1 / std::sin(i));
        fmt::print(out, "azimuth,{},{:.1f},{:.2f}\n", facet.name,
                   rounded(std::fmod(a + 360, 360), 0.1), rounded(0.1 / std::sin(i), 0.01));
    }
    for (const int a : {0, 30, 60, 90, 120, 150}) {
        const double w = width_along(truth, direction(radians(a), std::numbers::pi / 2, true));
        fmt::print(out, "width,{},{:.2f},0.01\n", a, rounded(w + instrument.normal(0.01), 0.01));
    }
    fmt::print(out, "depth,,{:.2f},0.01\n",
               rounded(width_along(truth, {0, 0, 1}) + instrument.normal(0.01), 0.01));
    // Lengths read under a microscope with a scale in the eyepiece.
    const HalfEdges links = half_edges(truth);
    const auto prefix = [](const std::string& name) {
        return name.substr(0, name[0] == 'G' || name[0] == 'T' ? 1 : 2);
    };
    for (const auto& [upper, lower] :
         std::vector<std::pair<std::string, std::string>>{{"T", "C3"},
                                                          {"C3", "C2"},
                                                          {"C2", "C1"},
                                                          {"C1", "G"},
                                                          {"G", "P1"},
                                                          {"P1", "P2"},
                                                          {"P2", "P3"}}) {
        for (const Edge& edge : links.edges) {
            const std::string& a = truth.facets[edge.left].name;
            const std::string& b = truth.facets[edge.right].name;
            const bool same_side =
                a == "T" || b == "T" || a.substr(prefix(a).size()) == b.substr(prefix(b).size());
            if (!same_side || !((prefix(a) == upper && prefix(b) == lower) ||
                                (prefix(b) == upper && prefix(a) == lower)))
                continue;
            const double l = glm::length(truth.vertices[edge.from] - truth.vertices[edge.to]);
            fmt::print(out, "edge,{}/{},{:.2f},0.03\n", prefix(a) == upper ? a : b,
                       prefix(a) == upper ? b : a, rounded(l + instrument.normal(0.03), 0.01));
        }
    }
    fmt::print(out, "weight,,{:.3f},0.002\n",
               rounded(carat(volume(truth), 3.06) + instrument.normal(0.002), 0.001));
}

// A lens of a little blur, photon and read noise, an exposure that is not the render's, 8 bit sRGB.
int photograph(const std::string& in, const std::string& out) {
    cv::Mat radiance = cv::imread(in, cv::IMREAD_UNCHANGED);
    if (radiance.empty()) return 1;
    if (radiance.channels() == 4) cv::cvtColor(radiance, radiance, cv::COLOR_BGRA2BGR);
    radiance.convertTo(radiance, CV_64F);
    cv::GaussianBlur(radiance, radiance, cv::Size(), 0.7);
    Deviates sensor(1839);
    const std::array<double, 3> gain = {0.78, 0.75, 0.72};  // B, G, R: exposure and white balance
    cv::Mat photo(radiance.size(), CV_8UC3);
    for (int y = 0; y < photo.rows; ++y) {
        for (int x = 0; x < photo.cols; ++x) {
            for (int c = 0; c < 3; ++c) {
                const double signal = gain[c] * radiance.at<cv::Vec3d>(y, x)[c];
                // 4000 electrons at full scale, 6 electrons of read noise.
                const double noise =
                    std::sqrt(std::max(signal, 0.0) / 4000 + 36.0 / (4000.0 * 4000.0));
                const double linear = std::clamp(signal + sensor.normal(noise), 0.0, 1.0);
                const double srgb = linear <= 0.0031308 ? 12.92 * linear
                                                        : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
                photo.at<cv::Vec3b>(y, x)[c] = static_cast<unsigned char>(std::lround(255 * srgb));
            }
        }
    }
    return cv::imwrite(out, photo) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() == 2 && words[0] == "stone") {
        const std::filesystem::path folder = words[1];
        const Solid truth = true_stone();
        write_cut(truth, {}, folder / "making" / "truth.asc");
        write_solid(truth, folder / "making" / "truth.obj");
        write_solid(hand_mesh(), folder / "hand.obj");
        write_readings(truth, folder / "readings.csv");
        return 0;
    }
    if (words.size() == 3 && words[0] == "photograph") return photograph(words[1], words[2]);
    fmt::print(stderr,
               "make_dravite_step stone FOLDER | make_dravite_step photograph TRUE.exr OUT.png\n");
    return 2;
}
