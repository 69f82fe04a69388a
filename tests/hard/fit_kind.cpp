// Cases of kind "fit": readings of a known stone. Expectations: that stone, and an honest statement
// of how far the answer can be trusted.
//
// [stone] as in hard_solids.h (shape = "brilliant": 73 facets, exact meets). [readings]:
//   set = all (inclinations, azimuths, edges, widths, depth) | angles | lengths | one | none
//   angle_sigma_deg, length_sigma (of the diameter), `sigma`: factor on both
//   noise: in standard deviations, drawn from `seed`; alternate: every reading is off by so many of
//   its sigmas, up and down in turn; repeat: the number of copies of each; exact_conflict_deg: the
//   difference of two exact readings of one facet. [mesh]: shaken, by so much of the diameter; or
//   shaken_of_shortest_edge, by so much of the truth's shortest edge. [expect]: status, one or
//   several.

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>

#include "fit/fit.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"
#include "tests/fit/test_stones.h"
#include "tests/hard/hard_kinds.h"
#include "tests/hard/hard_solids.h"
#include "tests/hard/textbook.h"

namespace culet::hard {

namespace {

struct FitCase {
    Solid truth;
    Stone mesh;
    std::vector<Reading> readings;
    std::vector<std::string> expected;
    std::optional<FitResult> found;

    const FitResult& result() {
        if (!found) found = fit_stone(mesh, readings);
        return *found;
    }
};

std::vector<Reading> make_readings(const TomlTable& t, const Solid& truth,
                                   const std::string& table_name) {
    t.refuse_unknown({"set", "angle_sigma_deg", "length_sigma", "sigma", "noise", "seed", "repeat",
                      "alternate", "exact_conflict_deg"});
    const std::string set = t.text("set").value_or("all");
    const double factor = t.number("sigma").value_or(1), size = diameter(truth);
    const double angle = factor * radians(t.number("angle_sigma_deg").value_or(0.1)),
                 length = factor * size * t.number("length_sigma").value_or(1e-3);
    std::vector<Reading> readings;
    if (set == "all" || set == "angles") readings = test::all_angles(truth, angle, table_name);
    if (set == "all" || set == "lengths") {
        for (Reading& r : test::all_edges(truth, length)) readings.push_back(std::move(r));
        for (int k = 0; k < 8; ++k) readings.push_back(test::width(truth, 22.5 * k, length));
        readings.push_back(test::depth(truth, length));
    }
    if (set == "one") readings.push_back(test::depth(truth, length));
    const double noise = t.number("noise").value_or(0),
                 by_turns = t.number("alternate").value_or(0);
    std::mt19937_64 random(static_cast<unsigned>(t.integer("seed").value_or(1)));
    std::normal_distribution<double> normal;
    for (Reading& r : readings) r.value += noise * r.sigma * normal(random);
    std::vector<Reading> all;
    const auto repeat = t.integer("repeat").value_or(by_turns > 0 ? 2 : 1);
    for (const Reading& r : readings) {
        for (std::int64_t k = 0; k < repeat; ++k) {
            all.push_back(r);
            if (repeat > 1) all.back().id += fmt::format("#{}", k);
            // Instruments do not show more than 90 degrees, so a pair there cannot be on both
            // sides.
            const bool upright =
                r.kind == ReadingKind::inclination && r.value + by_turns * r.sigma > radians(90);
            if (!upright) all.back().value += by_turns * r.sigma * (k % 2 == 0 ? 1 : -1);
            if (r.kind == ReadingKind::inclination) {
                all.back().value = radians(90) - std::abs(radians(90) - all.back().value);
            }
        }
    }
    if (const auto conflict = t.number("exact_conflict_deg")) {
        for (int k = 0; k < 2; ++k) {
            Reading r = readings.front();
            r.id = fmt::format("exact{}", k);
            r.exact = true;
            r.value += k * radians(*conflict);
            all.push_back(r);
        }
    }
    return all;
}

// Compares areas of facets and their angles to the vertical with the truth's, in any pose.
double shape_error(const Solid& solid, const Solid& truth, double scale = 1) {
    const double size = diameter(truth);
    double worst = 0;
    for (const Facet& f : truth.facets) {
        const int other = find_facet(solid, f.name);
        if (other < 0) return 1e300;
        const Facet& g = solid.facets[std::size_t(other)];
        worst = std::max(
            {worst, std::abs(area(solid, g) / (scale * scale) - area(truth, f)) / (size * size),
             std::abs(glm::length(g.plane.normal) - 1)});
    }
    return std::max(worst, std::abs(volume(solid) / (scale * scale * scale * volume(truth)) - 1));
}

int not_numbers(const FitResult& result) {
    int bad = 0;
    for (const FittedFacet& f : result.facets) {
        bad += !std::isfinite(f.plane.normal.x + f.plane.normal.y + f.plane.normal.z +
                              f.plane.offset + f.area + f.inclination);
        bad += !(f.sigma_offset >= 0) && !std::isnan(f.sigma_offset);
    }
    for (const FittedReading& r : result.readings) {
        // An azimuth of a facet that is level within its uncertainty is left out.
        if (!r.left_out.empty()) continue;
        bad += !std::isfinite(r.fitted + r.residual);
        bad += !(r.redundancy >= -1e-9 && r.redundancy <= 1 + 1e-9);
    }
    for (const Vec3& v : result.solid.vertices) bad += !std::isfinite(v.x + v.y + v.z);
    bad += !std::isfinite(result.statistics.chi2 + result.statistics.dof);
    bad += !nlohmann::json::accept(fit_report(result));
    return bad;
}

double shortest_edge(const Solid& solid) {
    double shortest = diameter(solid);
    for (const Facet& f : solid.facets) {
        for (std::size_t i = 0; i < f.corners.size(); ++i) {
            const Vec3 &a = solid.vertices[std::size_t(f.corners[i])],
                       &b = solid.vertices[std::size_t(f.corners[(i + 1) % f.corners.size()])];
            shortest = std::min(shortest, glm::distance(a, b));
        }
    }
    return shortest;
}

FitCase make_case(const TomlTable& parameters) {
    FitCase c;
    const TomlTable stone = parameters.table("stone").value();
    c.truth = stone.text("shape") == "brilliant" ? test::brilliant() : hard_solid(stone);
    const std::string table_name = find_facet(c.truth, "T") >= 0 ? "T" : "";
    c.mesh = test::stone_of(c.truth, table_name);
    c.readings = make_readings(parameters.table("readings").value(), c.truth, table_name);
    if (const auto mesh = parameters.table("mesh")) {
        mesh->refuse_unknown({"shaken", "shaken_of_shortest_edge"});
        const double by =
            diameter(c.truth) * mesh->number("shaken").value_or(0) +
            shortest_edge(c.truth) * mesh->number("shaken_of_shortest_edge").value_or(0);
        c.mesh.solid = test::shaken(c.truth, by / std::sqrt(3.0), 7);
    }
    if (const auto expect = parameters.table("expect")) {
        c.expected = expect->words("status").value_or(std::vector<std::string>{});
    }
    return c;
}

}  // namespace

Subject fit_subject(const HardCase&, const HardPoint&, const TomlTable& parameters) {
    const auto c = std::make_shared<FitCase>(make_case(parameters));
    Subject subject;
    auto& is = subject.invariants;
    is["status"] = [c] {
        const std::string status = name_of(c->result().status);
        const bool expected =
            std::find(c->expected.begin(), c->expected.end(), status) != c->expected.end();
        return Measured{expected ? 0.0 : 1.0, std::nan(""), status + ": " + c->result().message};
    };
    is["closed_and_convex"] = [c] {
        const FitResult& r = c->result();
        auto faults = find_faults(r.solid, {.planarity = 1e-9});
        std::erase_if(faults, [](const Fault& f) { return f.kind == FaultKind::repeated_plane; });
        return Measured{double(faults.size()) + !r.checks.closed + !r.checks.convex, std::nan(""),
                        faults.empty() ? r.message : faults.front().what};
    };
    is["planar"] = [c] {
        return Measured{planarity(c->result().solid) / diameter(c->result().solid), std::nan(""),
                        ""};
    };
    is["truth"] = [c] {
        return Measured{shape_error(c->result().solid, c->truth), std::nan(""),
                        c->result().message};
    };
    is["finite"] = [c] { return Measured{double(not_numbers(c->result())), std::nan(""), ""}; };
    // Whatever the readings: a stone that could be cut, or a statement that it is none.
    is["sound_or_says_so"] = [c] {
        const FitResult& r = c->result();
        if (r.status == FitStatus::not_converged) return Measured{};
        const double off = std::max(1e-12 * diameter(r.solid), coordinate_rounding(r.solid));
        return Measured{
            double(!is_closed(r.solid)) + !is_convex(r.solid) + !(planarity(r.solid) <= off),
            std::nan(""), std::string(name_of(r.status)) + ": " + r.message};
    };
    is["admits_it"] = [c] {
        return Measured{c->result().status == FitStatus::converged ? 1.0 : 0.0, std::nan(""),
                        c->result().message};
    };
    is["refused"] = [c] {
        try {
            c->result();
        } catch (const InputError& error) {
            return Measured{0, std::nan(""), error.what()};
        }
        return Measured{1, std::nan(""), "was fitted"};
    };
    is["reordered"] = [c] {
        std::vector<Reading> readings = c->readings;
        std::shuffle(readings.begin(), readings.end(), std::mt19937_64(3));
        const FitResult other = fit_stone(c->mesh, readings);
        if (other.status != c->result().status) return Measured{1e300, std::nan(""), other.message};
        return Measured{shape_error(other.solid, c->result().solid), std::nan(""), ""};
    };
    // Earlier contents of memory must not matter: new memory is filled with other bytes each time.
    is["same_again"] = [c] {
        double apart = 0;
        std::optional<FitResult> before;
        for (const int filled_with : {0x01, 0xa5}) {
            mallopt(M_PERTURB, filled_with);
            FitResult now = fit_stone(c->mesh, c->readings);
            mallopt(M_PERTURB, 0);
            if (before) {
                apart += now.solid.vertices != before->solid.vertices;
                apart += now.log.iterations != before->log.iterations ||
                         now.statistics.chi2 != before->statistics.chi2;
            }
            before = std::move(now);
        }
        return Measured{apart, std::nan(""), ""};
    };
    is["units"] = [c] {
        Measured worst;
        for (const double factor : {1e-6, 1e6}) {
            Stone mesh = c->mesh;
            mesh.solid = scaled(mesh.solid, factor);
            std::vector<Reading> readings = c->readings;
            for (Reading& r : readings) {
                if (is_angle(r.kind)) continue;
                r.value *= factor;
                r.sigma *= factor;
            }
            const FitResult other = fit_stone(mesh, readings);
            const double error = other.status == c->result().status
                                     ? shape_error(other.solid, c->result().solid, factor)
                                     : 1e300;
            if (!(error <= worst.error)) {
                worst = {error, std::nan(""), fmt::format("x {}: {}", factor, other.message)};
            }
        }
        return worst;
    };
    is["last_digit"] = [c] {
        unsigned state = 1;
        std::vector<Reading> readings = c->readings;
        for (Reading& r : readings) r.value = nudged(r.value, state);
        const FitResult other = fit_stone(c->mesh, readings);
        if (other.status != c->result().status) return Measured{1e300, std::nan(""), other.message};
        return Measured{shape_error(other.solid, c->result().solid), std::nan(""), ""};
    };
    subject.contrasts.push_back(
        {"planar", "vertex-by-vertex relaxation, 2000 sweeps", [c] {
             Solid solid = c->mesh.solid;
             relax_vertices(solid, 2000);
             return Measured{planarity(solid) / diameter(solid), std::nan(""), ""};
         }});
    return subject;
}

}  // namespace culet::hard
