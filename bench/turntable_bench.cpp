// Fits facets to the outlines in pictures of a simulated turntable, and measures their error.
//   bench_turntable [--cut NAME] [--pictures N] [--size PIXELS] [--seed N]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "compare/turntable/turntable.h"
#include "fit/fit.h"
#include "fit/silhouettes/contour_files.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/solid/least_rotation.h"
#include "tests/compare/simulated_photo.h"
#include "tests/compare/turned_stone.h"
#include "tests/cpu_time.h"

namespace culet::bench {

namespace {

Stone stone_of(Solid solid) {
    Stone stone;
    stone.solid = std::move(solid);
    stone.up_facet = "T";
    stone.facets_are_whole = true;
    return stone;
}

Solid of_width(Solid solid, double width) {
    double radius = 0;
    for (const Vec3& v : solid.vertices) radius = std::max(radius, std::hypot(v.x, v.y));
    for (Vec3& v : solid.vertices) v *= width / 2 / radius;
    for (Facet& f : solid.facets) f.plane.offset *= width / 2 / radius;
    return solid;
}

double inclination_of(const Vec3& normal) {
    return std::acos(std::min(1.0, std::abs(normal.z)));
}

struct Errors {
    double squares = 0, far = 0;
    int count = 0, within = 0, all = 0;
    double rms() const { return std::sqrt((squares + far) / std::max(1, count)); }
};

// Compares each fitted facet with the true one that faces most nearly the same way, with the truth
// turned by `turn`. Inclinations count from the table.
Errors errors_of(const FitResult& fit, const Solid& truth, double turn) {
    const double c = std::cos(turn), s = std::sin(turn);
    const Vec3 table = truth.facets[std::size_t(find_facet(truth, "T"))].plane.normal;
    Errors errors;
    for (const FittedFacet& facet : fit.facets) {
        if (!(facet.area > 0.02) || std::abs(facet.plane.normal.z) > 0.999) continue;
        double most = -2, inclination = 0;
        for (const Facet& f : truth.facets) {
            const Vec3 n = turned_with(table, {0, 0, 1}, f.plane.normal);
            const double cosine =
                glm::dot(facet.plane.normal, Vec3{c * n.x - s * n.y, s * n.x + c * n.y, n.z});
            if (cosine <= most) continue;
            most = cosine;
            inclination = inclination_of(n);
        }
        const double off = inclination_of(facet.plane.normal) - inclination;
        ++errors.all;
        errors.within += std::abs(off) < facet.sigma_inclination;
        if (!(facet.area > 0.3)) continue;
        errors.squares += off * off;
        ++errors.count;
        // It matches another facet.
        if (most < std::cos(radians(2.0))) errors.far += 1;
    }
    return errors;
}

int run(const std::string& cut, int pictures, int size, unsigned seed) {
    std::mt19937_64 random(seed);
    const Solid catalogue = make_cut(cut);
    const Solid truth = synthetic::tilted_facets(of_width(catalogue, 6), radians(0.3), random);
    synthetic::TurntableTruth table;
    table.size = size;
    table.pixel = 7.2 / size;
    table.axis_px = 11.3;
    table.roll = radians(0.4);
    table.elevation = radians(0.7);
    const double step = 2 * std::numbers::pi / pictures;
    std::vector<BackLitOutline> outlines;
    double tracing = 0;
    for (int i = 0; i < pictures; ++i) {
        const Photo photo = synthetic::turned_picture(truth, step * i, table, random);
        const double start = clocks().cpu;
        outlines.push_back(back_lit_outline(photo));
        tracing += clocks().cpu - start;
    }
    double start = clocks().cpu;
    const Turntable found = turntable_of(outlines, step);
    fmt::print("{} pictures of {} px, traced in {:.1f} s, turntable found in {:.1f} s\n", pictures,
               size, tracing, clocks().cpu - start);
    fmt::print(
        "axis {:.3f} px (true {:.3f}), roll {:.4f} ({:.4f}), elevation {:.4f} ({:.4f}) deg, "
        "residual {:.3f} px\n",
        found.axis_px, table.axis_px, degrees(found.roll), degrees(table.roll),
        degrees(found.elevation), degrees(table.elevation), found.residual_px);
    auto set = std::make_shared<SilhouetteSet>();
    set->is_free = true;
    for (const PlacedOutline& outline : placed(outlines, step, found, table.pixel))
        set->contours.push_back(contour_of_polygon(outline.direction, outline.points, 0, 1));
    start = clocks().cpu;
    WrittenReading written;
    written.kind = "silhouette";
    written.outlines = set;
    FitOptions options;
    options.prior.source = Prior::Source::catalogue;
    const FitResult fit = fit_stone(fit_input(stone_of(catalogue), {written}), options);
    fmt::print("{} in {:.1f} s of processor time\n", name_of(fit.status), clocks().cpu - start);
    // The catalogue's cut may have any rotation: take the best fit.
    Errors best;
    for (int turn = 0; turn < 360; ++turn) {
        const Errors errors = errors_of(fit, truth, radians(turn));
        if (turn == 0 || errors.rms() < best.rms()) best = errors;
    }
    fmt::print(
        "inclinations of {} facets of 0.3 mm2 and more: {:.4f} degrees rms; within one sigma "
        "{:.0f} % of {}\n",
        best.count, degrees(best.rms()), 100.0 * best.within / best.all, best.all);
    return 0;
}

}  // namespace

}  // namespace culet::bench

int main(int argc, char** argv) {
    CLI::App program("facets from the outlines of a simulated turntable");
    std::string cut = "round-brilliant";
    int pictures = 72, size = 1200;
    unsigned seed = 1;
    program.add_option("--cut", cut)->capture_default_str();
    program.add_option("--pictures", pictures)->capture_default_str();
    program.add_option("--size", size)->capture_default_str();
    program.add_option("--seed", seed)->capture_default_str();
    CLI11_PARSE(program, argc, argv);
    return culet::bench::run(cut, pictures, size, seed);
}
