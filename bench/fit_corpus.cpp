#include "bench/fit_corpus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <random>

#include "stone/solid/checks.h"
#include "stone/solid/half_edges.h"
#include "tests/scanned_solid.h"

namespace culet::bench {

namespace {

using Readings = std::vector<WrittenReading>;

// Fits of one stone from several meshes, all compared with the fit from the stone itself.
class Sitter {
public:
    Sitter(Stone truth, Readings readings)
        : truth_(std::make_shared<Stone>(std::move(truth))),
          readings_(std::make_shared<Readings>(std::move(readings))),
          reference_(std::make_shared<std::unique_ptr<Trial>>()) {}

    CorpusFit from(const std::string& group, const std::string& name,
                   const std::function<Stone(const Stone&)>& mesh) const {
        const auto truth = truth_;
        const auto readings = readings_;
        const auto reference = reference_;
        return {group, name, [truth, readings, mesh] { return fit_mesh(mesh(*truth), *readings); },
                [truth, readings, reference]() -> const Trial& {
                    if (!*reference) {
                        *reference = std::make_unique<Trial>(fit_mesh(*truth, *readings));
                    }
                    return **reference;
                },
                *truth};
    }

private:
    std::shared_ptr<Stone> truth_;
    std::shared_ptr<Readings> readings_;
    std::shared_ptr<std::unique_ptr<Trial>> reference_;
};

struct Shape {
    TruthKind kind;
    bool symmetric;
};

Stone scanned_stone(const std::string& path) {
    Stone stone;
    stone.solid = scanned_solid(path);
    const auto level = std::max_element(
        stone.solid.facets.begin(), stone.solid.facets.end(),
        [](const Facet& a, const Facet& b) { return a.plane.normal.z < b.plane.normal.z; });
    stone.up_facet = level->name;
    return stone;
}

WrittenReading reading(const std::string& kind, std::vector<std::string> of, double value,
                       double sigma) {
    WrittenReading r;
    r.kind = kind;
    r.of = std::move(of);
    r.value = value;
    r.sigma = sigma;
    return r;
}

Readings scanner_readings(const Truth& truth, unsigned seed) {
    const Solid& solid = truth.stone.solid;
    Readings readings;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto add = [&](const char* kind, std::vector<std::string> of, double value,
                         double sigma) {
        readings.push_back(reading(kind, std::move(of), value + sigma * normal(random), sigma));
    };
    for (const Facet& f : solid.facets) {
        if (f.name == truth.stone.up_facet) continue;
        add("inclination", {f.name}, degrees(inclination(f.plane.normal, {0, 0, 1})),
            truth.angle_sigma_deg);
        // Instruments read at most 90 degrees.
        *readings.back().value = 90 - std::abs(90 - std::abs(*readings.back().value));
    }
    for (int k = 0; k < 12; ++k) {
        const double a = radians(15.0 * k);
        add("width", {fmt::format("{}", 15 * k)}, width_along(solid, {std::cos(a), std::sin(a), 0}),
            truth.length_sigma);
    }
    add("depth", {}, width_along(solid, {0, 0, 1}), truth.length_sigma);
    for (const Edge& e : half_edges(solid).edges) {
        const double length = glm::length(solid.vertices[e.from] - solid.vertices[e.to]);
        add("edge", {solid.facets[e.left].name, solid.facets[e.right].name}, length,
            truth.length_sigma);
        *readings.back().value = std::max(1e-4, *readings.back().value);
    }
    for (WrittenReading& azimuth : read_azimuths(truth, seed + 1)) {
        // A level facet, a culet, has no azimuth.
        if (std::isfinite(*azimuth.sigma)) readings.push_back(std::move(azimuth));
    }
    return readings;
}

}  // namespace

std::vector<CorpusFit> synthetic_corpus(unsigned seeds) {
    std::vector<CorpusFit> corpus;
    const std::vector<Shape> shapes{{TruthKind::round, true}, {TruthKind::round, false},
                                    {TruthKind::step, true},  {TruthKind::step, false},
                                    {TruthKind::pear, false}, {TruthKind::trillion, false}};
    for (const Shape& shape : shapes) {
        const std::string kind =
            fmt::format("{}, {}", name_of(shape.kind), shape.symmetric ? "symmetric" : "none");
        for (unsigned seed = 1; seed <= seeds; ++seed) {
            const Truth truth = make_truth(shape.kind, shape.symmetric, seed);
            const Sitter sitter(truth.stone, read_by_instruments(truth, 1000 + seed));
            const unsigned draw = 77 * seed + 5;
            const auto add = [&](const char* error, double part, const auto& mesh) {
                const std::string group = fmt::format("{}, {} {:g} %", kind, error, 100 * part);
                corpus.push_back(sitter.from(
                    group, fmt::format("{}, seed {}", group, seed),
                    [part, draw, mesh](const Stone& stone) { return mesh(stone, part, draw); }));
            };
            for (const double part : {0.01, 0.05, 0.1, 0.2, 0.4}) add("noise", part, noisy_mesh);
            for (const double part : {0.1, 0.2}) add("drawn wrong", part, wrongly_drawn);
        }
    }
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const Truth truth = make_tiered(300, seed);
        const std::string group = "tiered 291, noise 0.3 %";
        corpus.push_back(
            Sitter(truth.stone, read_by_instruments(truth, 1000 + seed))
                .from(group, fmt::format("{}, seed {}", group, seed),
                      [seed](const Stone& stone) { return noisy_mesh(stone, 0.003, seed); }));
    }
    return corpus;
}

std::vector<CorpusFit> scanned_corpus(const std::string& file, unsigned draws) {
    Truth truth;
    truth.stone = scanned_stone(file);
    // The file's own name says little: `1_GIA/polyhedron.dat`.
    const std::filesystem::path path(file);
    const std::string name = "scan " + path.parent_path().filename().string();
    std::vector<CorpusFit> corpus;
    for (unsigned draw = 1; draw <= draws; ++draw) {
        const Sitter sitter(truth.stone, scanner_readings(truth, 100 * draw));
        corpus.push_back(sitter.from(name + ", own corners",
                                     fmt::format("{}, own corners, draw {}", name, draw),
                                     [](const Stone& stone) { return stone; }));
        corpus.push_back(
            sitter.from(name + ", noise 0.3 %", fmt::format("{}, noise 0.3 %, draw {}", name, draw),
                        [draw](const Stone& stone) { return noisy_mesh(stone, 0.003, draw); }));
    }
    return corpus;
}

}  // namespace culet::bench
