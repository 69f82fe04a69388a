// Fits scanned stones to half of their contours, and compares with the other half and with the
// scanner's own polyhedron.
//   bench_silhouettes FOLDER round-brilliant [FOLDER pear ...]
// FOLDER holds shadow_contours.dat and polyhedron.dat of one stone.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <iostream>

#include "fit/fit.h"
#include "fit/silhouettes/contour_files.h"
#include "fit/silhouettes/silhouette_fit.h"
#include "stone/cuts/cuts.h"
#include "stone/stone.h"
#include "tests/cpu_time.h"
#include "tests/scanned_solid.h"

namespace culet {
namespace {

constexpr double k_least_area = 0.3;  // mm2
constexpr double k_one_facet = 3;     // degrees

// As in the scanner: table down.
Solid as_scanned(Solid solid) {
    const auto turned = [](const Vec3& v) { return Vec3{v.x, -v.y, -v.z}; };
    for (Vec3& v : solid.vertices) v = turned(v);
    for (Facet& f : solid.facets) f.plane.normal = turned(f.plane.normal);
    return solid;
}

struct FacetErrors {
    int facets = 0, missing = 0;
    double rms_deg = 0, worst_deg = 0, rms_offset = 0;
};

// Compares with the nearest planes of the scanner, in its frame.
FacetErrors facet_errors(const FitResult& result, const FrameMotion& to_stone, const Solid& scan) {
    FacetErrors errors;
    double squares = 0, offsets = 0;
    for (const Facet& facet : scan.facets) {
        // The scanner holds the table down, where no contour reaches.
        if (area(scan, facet) < k_least_area || facet.plane.normal.z < -0.99) continue;
        const Vec3 normal = to_stone.turned(facet.plane.normal);
        double best = 1e300, offset = 0, sigma = 0, its_area = 0;
        std::string name;
        for (const FittedFacet& f : result.facets) {
            const double angle = angle_between(f.plane.normal, normal);
            if (angle > best || !(f.area > 0)) continue;
            best = angle;
            sigma = degrees(f.sigma_inclination);
            its_area = f.area;
            name = f.name;
            offset = f.plane.offset - (facet.plane.offset + glm::dot(normal, to_stone.shift));
        }
        if (degrees(best) > k_one_facet) {
            ++errors.missing;
            continue;
        }
        ++errors.facets;
        squares += best * best;
        offsets += offset * offset;
        errors.worst_deg = std::max(errors.worst_deg, degrees(best));
        if (std::getenv("CULET_BENCH_FACETS") != nullptr) {
            fmt::print(
                "   {:>8.3f} deg {:>7.2f} um  incl {:6.2f} area {:.2f} {} {:.2f} +- {:.3f}\n",
                degrees(best), 1e3 * offset, degrees(inclination(normal, {0, 0, 1})),
                area(scan, facet), name, its_area, sigma);
        }
    }
    errors.rms_deg = degrees(std::sqrt(squares / std::max(1, errors.facets)));
    errors.rms_offset = std::sqrt(offsets / std::max(1, errors.facets));
    return errors;
}

void measure(const std::filesystem::path& folder, const std::string& cut) {
    const ShadowContours read =
        read_shadow_contours(folder / "shadow_contours.dat", LengthUnit::mm);
    const Solid scan = as_scanned(scanned_solid(folder / "polyhedron.dat"));
    SilhouetteSet set;
    set.is_free = true;
    for (std::size_t i = 0; i < read.contours.size(); ++i) {
        (i % 2 == 0 ? set.contours : set.held_out).push_back(read.contours[i]);
    }
    const auto contours = set.contours, held_out = set.held_out;
    Stone mesh;
    mesh.solid = make_cut(cut);
    mesh.up_facet = "T";
    mesh.facets_are_whole = true;
    WrittenReading written;
    written.kind = "silhouette";
    written.outlines = std::make_shared<const SilhouetteSet>(std::move(set));
    const Clocks begin = clocks();
    const FitInput input = fit_input(mesh, {written});
    const Clocks middle = clocks();
    FitOptions options;
    options.prior.source = Prior::Source::catalogue;
    const FitResult result = fit_stone(input, options);
    const Clocks end = clocks();
    const SilhouetteFinding& finding = *result.readings.back().silhouette;
    const SilhouetteMisfit theirs = silhouette_misfit(scan, contours, held_out, {});
    // The motion from the scanner's frame to the stone's, estimated from the contours.
    const FacetErrors facets =
        facet_errors(result, input.readings.back().outline_observations->motions[0], scan);
    fmt::print("{}: {} contours, {} held out\n", folder.filename().string(), contours.size(),
               held_out.size());
    fmt::print(
        "  left out: rms {:.2f} um, worst {:.1f} um, {} outliers; the scanner's polyhedron "
        "{:.2f} um, {} outliers; ratio {:.3f}\n",
        1e3 * finding.held_out->rms, 1e3 * finding.held_out->worst, finding.held_out->outliers,
        1e3 * theirs.rms, theirs.outliers, finding.held_out->rms / theirs.rms);
    fmt::print("  fitted: rms {:.2f} um, sigma {:.2f} um, {} facets\n", 1e3 * finding.misfit.rms,
               1e3 * finding.sigma, result.facets.size());
    fmt::print(
        "  facets of {} mm2 and more: {} ({} missing), {:.3f} degrees rms, {:.3f} worst, "
        "{:.2f} um of offset\n",
        k_least_area, facets.facets, facets.missing, facets.rms_deg, facets.worst_deg,
        1e3 * facets.rms_offset);
    fmt::print("  {:.2f} + {:.2f} s of CPU; {}: {}\n", middle.cpu - begin.cpu, end.cpu - middle.cpu,
               name_of(result.status), result.message);
}

}  // namespace
}  // namespace culet

int main(int argc, char** argv) {
    try {
        for (int i = 1; i + 1 < argc; i += 2) culet::measure(argv[i], argv[i + 1]);
    } catch (const std::exception& error) {
        std::cerr << "bench_silhouettes: " << error.what() << "\n";
        return 2;
    }
    return 0;
}
