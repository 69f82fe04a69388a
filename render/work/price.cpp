#include "render/work/price.h"

#include <algorithm>
#include <cmath>

namespace culet {

namespace {

// Nanoseconds, measured by bench_plan --prices.
constexpr double k_ray = 60, k_event = 150, k_plain_event = 135, k_exit_node = 1.5;
constexpr double k_general_ray = 1500, k_general_event = 450;
// Per edge and face met. Fits a heart in `jeweller` and `idealscope` (with rays that leave and meet
// it again), relative to a zircon by the reference. Brilliants of 73 and 145 facets, drawn as not
// convex, took half.
constexpr double k_edge = 9;
// Rough: a brilliant of 145 facets next to a ball on a plane took 16.4 s of an allowed 16 s.
constexpr double k_met = 600;
// Fitted to 1600 pixels of stone at tolerance 0.03: round brilliants and step cuts of quartz,
// garnet, sapphire, zircon and diamond, within a factor of 1.6. of_cut: time rose by 1.3 to 2.4
// from a cut of 0.1 to 0.01 (64 to 400 pixels across). of_fine: by 1.9 to 2 from tolerance 0.03 to
// 0.01, by 4.4 from there to 0.001 (diamonds, 200 pixels across). Split beams of corundum and
// tanzanite (100 pixels across): by 2 to 2.2 for 0.44 times the cut, by 3.5 for 0.22 times the cut
// and 0.16 times the tolerance.
constexpr double k_stone = 8e6, k_beam = 1300, k_pixels = 1600, k_tolerance = 0.03;
struct BeamCount {
    double at_one_event, of_events, of_pixels, of_tolerance, of_fine, of_cut;  // factor; powers
    double at(const BeamWork& work) const {
        const double cut = work.cut > 0 ? work.cut : work.tolerance;
        return at_one_event * std::pow(std::max(work.events_per_ray, 1.0), of_events) *
               std::pow(std::max(work.pixels, 1.0) / k_pixels, of_pixels) *
               std::pow(k_tolerance / work.tolerance,
                        work.tolerance < k_tolerance ? of_fine : of_tolerance) *
               std::pow(k_tolerance / cut, of_cut);
    }
};
constexpr BeamCount k_single{330, 1.1, 0.5, 0.25, 0.6, 0.2},
    k_split{11500, 0.45, 0.4, 0.1, 0.1, 0.85};
constexpr double k_grown_beam = 300, k_split_beam = 1500, k_fragment = 60;
// Per face met by beams that follow their middle ray alone, and by up to eight fragments at once.
constexpr double k_walked = 45, k_shaded_face = 100;
// Price of each further wavelength along the same path, as a share of the beam's.
constexpr double k_node = 0.1;

}  // namespace

double price_ns(const PathWork& work) {
    const double event = work.general     ? k_general_event + work.nodes
                         : work.polarised ? k_event + k_exit_node * (work.nodes - 1)
                                          : k_plain_event + k_exit_node * (work.nodes - 1);
    return k_met * work.met + (work.general ? k_general_ray : k_ray) * work.rays +
           (event + k_edge * work.edges) * work.events;
}

double price_ns(const DrawnBeams& work) {
    const double nodes = 1 + k_node * (work.nodes - 1);
    return k_grown_beam * static_cast<double>(work.grown) +
           k_walked * static_cast<double>(work.walked) +
           nodes * (k_split_beam * static_cast<double>(work.split) +
                    k_fragment * static_cast<double>(work.fragments) +
                    k_shaded_face * static_cast<double>(work.faces));
}

double price_ns(const BeamWork& work) {
    const double beams = (work.split ? k_split : k_single).at(work);
    const double each = work.views * work.bands * (work.polarised ? 1.08 : 1.0);
    return k_stone + each * k_beam * beams * (1 + k_node * (work.nodes - 1));
}

}  // namespace culet
