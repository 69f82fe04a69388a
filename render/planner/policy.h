#pragma once
// Constants of the planner. `bench_plan` (60 scenes, tolerances 0.1 to 0.003: bounds, measured
// errors, processor time) shows the effect of a change; other sources are named. Shares are of the
// tolerance unless stated otherwise.

#include <array>
#include <cstddef>

namespace culet {

// Pilots: the same pixels of the stone are drawn with and without an effect.

/// Pixels of a pilot, spread evenly; fewer for coherence, where each wavelength has its own tree.
inline constexpr int k_pilot_pixels = 96, k_coherence_pixels = 16;
/// Rays per pilot pixel, for a pinhole and for a lens.
inline constexpr int k_pilot_rays = 4, k_lens_rays = 16;
/// Weight at which a pilot's paths end, as a share of the tolerance; at which trees play roulette.
inline constexpr double k_pilot_cut = 0.03, k_pilot_roulette = 0.01;
/// Joint error of all omitted effects (root of the sum of squares); limit for one that is cheap to
/// draw.
inline constexpr double k_share_of_effects = 0.25, k_share_of_cheap = 0.05;
/// Wavelengths of the pilot of dispersion.
inline constexpr int k_spectral_nodes = 15;
/// Rays per pixel of all pilots together, and faces per ray: the rough cost of weighing effects.
inline constexpr double k_rays_of_pilots = 160, k_faces_per_ray = 8;

// The error estimate: a picture against the reference at some pixels.

/// Standard errors added to the mean in a bound.
inline constexpr double k_standard_errors = 3;
/// Pixels of the first look, and at most.
inline constexpr std::size_t k_first_pixels = 48, k_most_pixels = 3072;
/// Sides of the truth's successive grids of rays. None is a level of the reference: its picture
/// would share the truth's rays.
inline constexpr std::array k_truth_sides{4, 5, 7, 11, 15, 22, 32, 46};
/// Weight below which the truth's paths end.
inline constexpr double k_truth_cut = 0.01;
/// Below this tolerance, truth and pictures use more wavelengths and larger trees.
inline constexpr double k_fine_tolerance = 0.02;
/// Trees play roulette below tree_cut and follow both branches above tree_split. With few rays,
/// noise falls fastest if few branches are followed.
constexpr double tree_cut(double tolerance) {
    return tolerance < k_fine_tolerance ? 0.01 : 0.04;
}
constexpr double tree_split(double tolerance) {
    return tolerance < k_fine_tolerance ? 0.3 : 0.6;
}
/// While noise exceeds half of the difference, a step may cost this many times as much: no other
/// picture could pass with so much noise either.
inline constexpr double k_noisy_price = 12;
/// Share of the pixels chosen evenly; the rest go to contrast and to edges of bright lights.
inline constexpr double k_even_share = 0.4;
/// Lights this many times as bright as the picture's mean are searched for where it lacks them. A
/// sun is a hundred times brighter still.
inline constexpr double k_bright = 8;
/// Pixels with this share of the picture's light (times the tolerance) and 30 times its mean are
/// always checked.
inline constexpr double k_outlier_share = 1.0 / 24;
inline constexpr std::size_t k_most_outliers = 96;

// The scan for edges of bright lights (light_edge_scan.h).

/// Pixels along a cell when scanned by beams, which miss no region; else the number of cells, one
/// ray each.
inline constexpr int k_cell = 3, k_scanned_pixels = 1000;
/// Scanned pixels across the stone: details in larger pictures are larger, too.
inline constexpr double k_across = 200;
/// The cells that may be off most are looked at again, each time fewer at more wavelengths.
struct CloserLook {
    std::size_t cells;
    int wavelengths;
};
inline constexpr std::array<CloserLook, 2> k_closer{{{512, 8}, {96, 29}}};
/// Weight at which the scan's paths end; for a sun a hundredth of it. Weaker paths are left to the
/// evenly chosen pixels.
inline constexpr double k_cut_weight = 0.01;

// Levels of refinement.

/// Error that the next picture aims at. The closer to the tolerance, the more pixels a decision
/// takes.
inline constexpr double k_aim = 0.5;
/// Borders of the first beams; factors per level for borders and cut weights. Errors fall as the
/// root of the borders (docs/engines.md), so they about halve.
inline constexpr double k_coarsest = 0.1, k_finer_borders = 0.25, k_finer_paths = 1.0 / 3;
inline constexpr int k_most_levels_at_once = 3;
/// Crystals' paths end without roulette at k_crystal_cut x tolerance^(1/0.6); a cut of 0.009 lost
/// 0.047 of the light.
inline constexpr double k_crystal_cut = 0.32, k_crystal_power = 0.6;
/// Price of beams over the price of a preview.
inline constexpr double k_price_over_preview = 2.2;
/// Levels of the reference.
struct ReferenceLevel {
    int rays, wavelengths;
};
inline constexpr std::array<ReferenceLevel, 9> k_reference_levels{
    {{1, 3}, {4, 8}, {9, 29}, {36, 57}, {64, 57}, {144, 57}, {256, 57}, {576, 57}, {1600, 57}}};
/// The error of N rays falls as N to minus this power (grids: 0.75; trees: less).
inline constexpr double k_power_of_rays = 0.7;
/// Error of a sun's images at three wavelengths per radian of dispersion; share of the tolerance
/// for it.
inline constexpr double k_sun_apart = 0.8, k_share_of_sun = 0.2;
/// Most pictures per set of effects; while a crystal's waves are tentatively merged.
inline constexpr int k_most_drawings = 7, k_most_merged = 3;
/// Effects that were left out come back if they cause more than this share of the error.
inline constexpr double k_misjudged = 0.7;
/// Price of a step of a check over the picture's; after the last picture.
inline constexpr double k_check_share = 1.5, k_last_check_share = 6;

// The time budget.

/// The first tolerance; work rises as tolerance to minus this power.
inline constexpr double k_first_tolerance = 0.2, k_power_of_work = 1.5;
/// The next picture is drawn only if its tolerance is finer by this factor.
inline constexpr double k_worth_drawing = 1.25;
/// If the usual time leaves a larger error by estimate, or no picture, the stone gets longer.
inline constexpr double k_rough = 0.1;
/// Share of the remaining work that the next picture may take by estimate.
inline constexpr double k_share_of_rest = 0.8;
/// With objects around the stone: pixels at which work is counted, and most rays per pixel.
inline constexpr int k_counted_pixels = 256, k_most_samples = 4096;

}  // namespace culet
