// Do pictures of stones drawn from a fit's uncertainty contain the true stone's picture as often as
// they claim? Known stones are measured with simulated noise, fitted, and drawn. Of the truth's
// pixels 68.3 % should lie within one sigma and 95.4 % within two.
//   bench_uncertainty [--stones N] [--draws N] [--size PIXELS]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Dense>
#include <cmath>

#include "fit/fit.h"
#include "refine/fit_uncertainty.h"
#include "render/render.h"
#include "render/scene/light_presets.h"
#include "render/uncertainty/picture_uncertainty.h"
#include "stone/material/material_io.h"
#include "tests/cpu_time.h"
#include "tests/fit/fit_truth.h"

namespace culet::bench {

namespace {

using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic>;

Rows columns(const std::vector<Vec3>& vectors) {
    Rows rows(3, vectors.size());
    for (std::size_t i = 0; i < vectors.size(); ++i)
        rows.col(Eigen::Index(i)) << vectors[i].x, vectors[i].y, vectors[i].z;
    return rows;
}

// The true stone aligned with the fit, as a photograph's registration would place it.
Solid laid_on(const Solid& truth, const Solid& fitted) {
    std::vector<Vec3> normals, corners;
    std::vector<Plane> from, to;
    for (const Facet& facet : fitted.facets) {
        const int at = find_facet(truth, facet.name);
        if (at < 0) continue;
        from.push_back(truth.facets[std::size_t(at)].plane);
        to.push_back(facet.plane);
    }
    std::vector<Vec3> source, target;
    for (std::size_t i = 0; i < from.size(); ++i) {
        source.push_back(from[i].normal);
        target.push_back(to[i].normal);
    }
    // Rotations only: umeyama subtracts the mean, which is wrong for normals.
    const Eigen::Matrix3d product = columns(target) * columns(source).transpose();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
    const Eigen::Matrix3d turn = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    const auto turned = [&](const Vec3& v) {
        const Eigen::Vector3d w = turn * Eigen::Vector3d(v.x, v.y, v.z);
        return Vec3{w.x(), w.y(), w.z()};
    };
    // The shift that best matches the planes' distances.
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 n = turned(from[i].normal);
        const Eigen::Vector3d e(n.x, n.y, n.z);
        normal += e * e.transpose();
        right += e * (to[i].offset - from[i].offset);
    }
    const Eigen::Vector3d s = normal.ldlt().solve(right);
    std::vector<NamedPlane> planes;
    for (const Facet& facet : truth.facets) {
        const Vec3 n = turned(facet.plane.normal);
        planes.push_back(
            {facet.name, {n, facet.plane.offset + n.x * s.x() + n.y * s.y() + n.z * s.z()}});
    }
    return intersect_half_spaces(planes).solid;
}

Scene scene_of(const Solid& solid, const std::string& light, int size) {
    Scene scene;
    scene.stone.solid = solid;
    scene.stone.material = catalogue_material("quartz");
    scene.lights = *light_preset(light);
    double width = 0;
    for (const Vec3& v : solid.vertices) width = std::max(width, 2.1 * std::hypot(v.x, v.y));
    scene.camera.position = {0, 0, 100};
    scene.camera.orthographic_width = width;
    scene.camera.width = scene.camera.height = size;
    scene.settings.wavelengths_nm = {589};
    scene.settings.engine = "beams";
    scene.settings.effects_auto = false;
    scene.settings.effects = {};
    scene.settings.check = Check::none;
    scene.settings.depth = 10;
    return scene;
}

struct Coverage {
    double pixels = 0, one = 0, two = 0, sigma_one = 0, sigma_two = 0;
    void add(const Coverage& other) {
        pixels += other.pixels;
        one += other.one;
        two += other.two;
        sigma_one += other.sigma_one;
        sigma_two += other.sigma_two;
    }
    void say(const std::string& name) const {
        fmt::print("{:<22} {:6.0f} {:7.1f} {:7.1f} {:9.1f} {:7.1f}\n", name, pixels,
                   100 * one / pixels, 100 * two / pixels, 100 * sigma_one / pixels,
                   100 * sigma_two / pixels);
        std::fflush(stdout);
    }
};

Coverage coverage_of(const Picture& truth, const PictureUncertainty& found) {
    Coverage coverage;
    for (std::size_t p = 0; p < truth.pixels(); ++p) {
        if (truth.coverage[p] < 1) continue;
        const double light = luminance(truth.rgb.data() + 3 * p);
        const float* bands = found.bands.data() + 4 * p;
        const double mean = luminance(found.mean.data() + 3 * p),
                     sigma = double(found.sigma_luminance[p]), off = std::abs(light - mean);
        // Single-precision rounding, where nothing is uncertain.
        const double rounding = 1e-6 * light;
        ++coverage.pixels;
        coverage.one +=
            light >= double(bands[1]) - rounding && light <= double(bands[2]) + rounding;
        coverage.two +=
            light >= double(bands[0]) - rounding && light <= double(bands[3]) + rounding;
        coverage.sigma_one += off <= sigma + rounding;
        coverage.sigma_two += off <= 2 * sigma + rounding;
    }
    return coverage;
}

std::optional<Coverage> one_stone(TruthKind kind, unsigned seed, const std::string& light, int size,
                                  int draws) {
    const Truth truth = make_truth(kind, false, seed);
    std::vector<WrittenReading> readings = read_by_instruments(truth, seed + 1000);
    for (const WrittenReading& azimuth : read_azimuths(truth, seed + 2000))
        readings.push_back(azimuth);
    const Stone mesh = noisy_mesh(truth.stone, 0.01, seed);
    const FitResult fit = fit_stone(mesh, bind_readings(readings, mesh));
    if (!fit.usable()) return std::nullopt;
    const Scene scene = scene_of(fit.solid, light, size);
    ScenePlan plan;
    plan.settings = scene.settings;
    const PictureUncertainty found = picture_uncertainty(scene, plan, uncertainty_of(fit), draws);
    Scene of_truth = scene;
    of_truth.stone.solid = laid_on(truth.stone.solid, fit.solid);
    return coverage_of(render_as_planned(of_truth, plan).picture, found);
}

int run(int stones, int draws, int size) {
    fmt::print("{} draws, {} x {} pixels; per cent of the true stone's pixels\n", draws, size,
               size);
    fmt::print("{:<22} {:>6} {:>7} {:>7} {:>9} {:>7}\n", "", "pixels", "16-84", "2-98", "+-1 sigma",
               "+-2");
    const double start = clocks().cpu;
    const TruthKind kinds[] = {TruthKind::round, TruthKind::step, TruthKind::pear,
                               TruthKind::trillion};
    Coverage all;
    int failed = 0;
    for (int i = 0; i < stones; ++i) {
        const TruthKind kind = kinds[i % 4];
        const std::string light = i % 8 < 4 ? "jeweller" : "daylight";
        const auto found = one_stone(kind, unsigned(i) + 1, light, size, draws);
        if (!found) {
            ++failed;
            continue;
        }
        found->say(fmt::format("{} {}, {}", name_of(kind), i + 1, light));
        all.add(*found);
    }
    all.say(fmt::format("all; to be reached: 68.3 and 95.4"));
    fmt::print("{} of {} fits found no stone; {:.0f} s of processor time\n", failed, stones,
               clocks().cpu - start);
    return 0;
}

}  // namespace

}  // namespace culet::bench

int main(int argc, char** argv) {
    CLI::App program("coverage of the pictures drawn from a fit's uncertainty");
    int stones = 30, draws = 100, size = 96;
    program.add_option("--stones", stones)->capture_default_str();
    program.add_option("--draws", draws)->capture_default_str();
    program.add_option("--size", size)->capture_default_str();
    CLI11_PARSE(program, argc, argv);
    return culet::bench::run(stones, draws, size);
}
