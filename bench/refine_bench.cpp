// Refines facets from photographs. The stones' readings are off by a known angle; the stones are
// photographed (simulated) in known light, refined, and compared with the truth.
//
//     bench_refine [--stones 8] [--deg 0.3] [--photographs 3] [--light lobes|windows]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <glm/geometric.hpp>

#include "compare/calibration/draft_renderer.h"
#include "compare/calibration/facet_error.h"
#include "compare/calibration/simulated_camera.h"
#include "refine/refine.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"
#include "tests/cpu_time.h"

namespace {

using namespace culet;

struct Options {
    int stones = 4, photographs = 3, seed = 1, exact = 0, size = 360;
    double deg = 0.3, offset = 0.002;
    std::string cut = "round-brilliant", material = "cubic_zirconia", light = "lobes";
    bool keep_pose = false, true_pose = false;
};

Lights lobes() {
    Lights lights;
    lights.constant = 0.1;
    lights.sources.push_back(CosinePowerLight{Vec3{0.3, 0.1, 1}, 8, {Rgb{1.2, 1.1, 1.0}}});
    lights.sources.push_back(CosinePowerLight{Vec3{1, 0.3, 0.5}, 30, {Rgb{3.0, 2.8, 2.9}}});
    lights.sources.push_back(CosinePowerLight{Vec3{-0.5, 0.9, 0.4}, 20, {Rgb{1.0, 1.2, 0.8}}});
    return lights;
}

Lights windows() {
    Lights lights;
    lights.constant = 0.05;
    lights.sources.push_back(
        PlaneLight{Vec3{-6, 3, 10}, Vec3{0, 0, -1}, Vec3{4, 0, 0}, Vec3{0, 3, 0}, {Rgb{3, 3, 3}}});
    lights.sources.push_back(
        PlaneLight{Vec3{7, -4, 6}, Vec3{-1, 0, 0}, Vec3{0, 4, 0}, Vec3{0, 0, 3}, {Rgb{2, 2, 2}}});
    return lights;
}

Scene scene_of(const Options& o, const Solid& solid) {
    Scene scene;
    scene.stone.solid = solid;
    scene.stone.material = catalogue_material(o.material);
    scene.camera.position = {0, 0, 40};
    scene.camera.up = {0, 1, 0};
    scene.camera.orthographic_width = 1.6 * diameter(solid);
    scene.camera.width = scene.camera.height = o.size;
    scene.lights = o.light == "windows" ? windows() : lobes();
    return scene;
}

Scene view(Scene scene, int k) {
    // Face up, then tilted 13 degrees to different sides.
    const double tilt = k == 0 ? radians(2) : radians(13), around = 2.1 * k + 0.3;
    scene.camera.position = 40.0 * Vec3{std::sin(tilt) * std::cos(around),
                                        std::sin(tilt) * std::sin(around), std::cos(tilt)};
    return scene;
}

// Readings of every facet's direction, with errors of `deg`.
FitInput input_of(const Solid& read, double deg) {
    FitInput input;
    input.stone.solid = read;
    input.stone.convex = true;
    const double sigma = radians(deg) / std::sqrt(2.0);
    for (std::size_t f = 0; f < read.facets.size(); ++f) {
        const Vec3& n = read.facets[f].plane.normal;
        const double inclination = std::acos(std::clamp(n.z, -1.0, 1.0));
        Reading reading;
        reading.kind = ReadingKind::inclination;
        reading.id = "i-" + read.facets[f].name;
        reading.of = {read.facets[f].name};
        reading.facets = {int(f)};
        reading.value = std::min(inclination, radians(180) - inclination);
        reading.sigma = sigma;
        reading.side = n.z >= 0 ? 1 : -1;
        if (std::abs(n.z) < 0.999) input.readings.push_back(reading);
        if (std::abs(n.z) > 0.999) continue;
        reading.kind = ReadingKind::azimuth;
        reading.id = "a-" + read.facets[f].name;
        reading.side = 0;
        reading.value = std::atan2(n.y, n.x);
        reading.sigma = sigma / std::sin(inclination);
        input.readings.push_back(reading);
    }
    Reading depth;
    depth.kind = ReadingKind::depth;
    depth.id = "depth";
    depth.value = width_along(read, {0, 0, 1});
    depth.sigma = 0.001 * depth.value;
    input.readings.push_back(depth);
    return input;
}

// Like an exposure meter: the brightest three per cent may clip.
double bright_of(const Photo& photo) {
    std::vector<float> values;
    for (std::size_t i = 0; i < photo.coverage.size(); ++i) {
        if (photo.coverage[i] > 0.99f) values.push_back(photo.rgb[3 * i + 1]);
    }
    const auto at = values.begin() + std::ptrdiff_t(0.97 * double(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return std::max(1e-6, double(*at));
}

struct Errors {
    double rms = 0, crown = 0, pavilion = 0, worst = 0, ratio = 0;
    int count = 0;
};

// Over facets except the girdle's, after the turn that fits all of them best.
Errors errors_of(const FitResult& fit, const Solid& truth) {
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    struct One {
        Vec3 n, off;
        const FittedFacet* facet;
    };
    std::vector<One> all;
    for (const FittedFacet& facet : fit.facets) {
        const int there = find_facet(truth, facet.name);
        if (there < 0 || std::abs(facet.plane.normal.z) < 0.1) continue;
        const Vec3 n = truth.facets[std::size_t(there)].plane.normal;
        all.push_back({n, facet.plane.normal - n, &facet});
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 e(0);
            e[axis] = 1;
            const Vec3 move = glm::cross(e, n);
            b[axis] += glm::dot(move, all.back().off);
            for (int other = 0; other < 3; ++other) {
                Vec3 d(0);
                d[other] = 1;
                a(axis, other) += glm::dot(move, glm::cross(d, n));
            }
        }
    }
    const Eigen::Vector3d turn = a.inverse() * b;
    Errors errors;
    int crown = 0, pavilion = 0, compared = 0;
    for (One& one : all) {
        one.off -= glm::cross(Vec3{turn[0], turn[1], turn[2]}, one.n);
        const double off = degrees(glm::length(one.off));
        errors.rms += off * off;
        errors.worst = std::max(errors.worst, off);
        (one.n.z > 0 ? errors.crown : errors.pavilion) += off * off;
        ++(one.n.z > 0 ? crown : pavilion);
        const double incline = std::acos(one.facet->plane.normal.z) - std::acos(one.n.z);
        if (one.facet->sigma_inclination > 0 && std::abs(one.n.z) < 0.999) {
            errors.ratio += std::pow(incline / one.facet->sigma_inclination, 2);
            ++compared;
        }
    }
    errors.count = int(all.size());
    errors.rms = std::sqrt(errors.rms / errors.count);
    errors.crown = std::sqrt(errors.crown / std::max(1, crown));
    errors.pavilion = std::sqrt(errors.pavilion / std::max(1, pavilion));
    errors.ratio = std::sqrt(errors.ratio / std::max(1, compared));
    return errors;
}

void run(const Options& o, int seed) {
    const Solid design = make_cut(o.cut);
    const auto truth = with_facet_error(design, radians(0.3), std::uint64_t(100 + seed));
    const auto read = with_facet_error(*truth, radians(o.deg), std::uint64_t(seed));
    const Scene scene = scene_of(o, *read);
    RefineOptions options;
    options.find_pose = !o.keep_pose;
    options.fit.prior.source = Prior::Source::mesh;
    options.fit.prior.always = true;
    options.fit.prior.offset_sigma = o.offset;
    std::vector<RefinePhotograph> photographs;
    for (int k = 0; k < o.photographs; ++k) {
        Scene shot = view(scene, k);
        shot.stone.solid = *truth;
        const DraftRenderer renderer(shot, getenv("TOLP") ? atof(getenv("TOLP")) : 0.01);
        CameraModel camera;
        const double gain = 0.9 / bright_of(renderer.picture());
        camera.gain = {gain, gain, gain};
        camera.ground = {0.02f, 0.02f, 0.02f};
        const Photo drawn = o.exact > 0 ? renderer.draw_exactly(shot, o.exact) : renderer.picture();
        photographs.push_back({fmt::format("photo-{}", k),
                               photographed(drawn, camera, std::uint64_t(10 * seed + k)),
                               o.true_pose ? std::optional(shot.camera) : std::nullopt});
    }
    const FitInput input = input_of(*read, o.deg);
    const Clocks begin = clocks();
    const RefineResult result = refine(input, photographs, scene, options);
    const Clocks end = clocks();
    const Errors before = errors_of(result.before, *truth), after = errors_of(result.after, *truth);
    fmt::print(
        "seed {}: before {:.3f} (sigma x {:.2f}), after {:.3f} (crown {:.3f}, pavilion {:.3f}, "
        "worst {:.2f}; sigma x {:.2f}), {}, {:.0f} s, {:.0f} s CPU\n",
        seed, before.rms, before.ratio, after.rms, after.crown, after.pavilion, after.worst,
        after.ratio, name_of(result.after.status), end.wall - begin.wall, end.cpu - begin.cpu);
    for (const std::string& note : result.after.log.notes) fmt::print("    {}\n", note);
    std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
    Options o;
    CLI::App app("facets from photographs");
    app.add_option("--stones", o.stones);
    app.add_option("--photographs", o.photographs);
    app.add_option("--seed", o.seed, "first");
    app.add_option("--deg", o.deg, "facet error of the readings");
    app.add_option("--offset", o.offset, "how well facets are placed, of the width");
    app.add_option("--cut", o.cut);
    app.add_option("--material", o.material);
    app.add_option("--light", o.light);
    app.add_option("--size", o.size);
    app.add_option("--exact", o.exact, "rays a pixel of the reference, in place of beams");
    app.add_flag("--keep-pose", o.keep_pose);
    app.add_flag("--true-pose", o.true_pose, "the cameras are known");
    CLI11_PARSE(app, count, words);
    for (int k = 0; k < o.stones; ++k) run(o, o.seed + k);
}
