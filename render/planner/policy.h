#pragma once
// The planner's constants, private to this folder. `bench_plan` (60 scenes, tolerances 0.1 to
// 0.003: bounds, measured errors, processor time) tells what a change of these costs; where another
// bench or a law decides, the line says so. Shares are of the tolerance where nothing else is said.

#include <array>
#include <cstddef>

namespace culet {

// Pilots: an effect is drawn and left out, at some pixels of the stone.

/// Pixels of a pilot, spread evenly; and of the pilot of coherence, of which each wavelength has a
/// tree of paths.
inline constexpr int k_pilot_pixels = 96, k_coherence_pixels = 16;
/// Rays in each of them, pinhole and lens.
inline constexpr int k_pilot_rays = 4, k_lens_rays = 16;
/// Weight below which a pilot's paths end: share of the tolerance; of trees, which play roulette.
inline constexpr double k_pilot_cut = 0.03, k_pilot_roulette = 0.01;
/// What all effects that are left out may be off by together, as the root of a sum of squares; and
/// one alone that costs next to nothing to draw.
inline constexpr double k_share_of_effects = 0.25, k_share_of_cheap = 0.05;
/// Wavelengths of the pilot of dispersion.
inline constexpr int k_spectral_nodes = 15;
/// Rays of all pilots of a scene together, per pixel: what weighing effects costs, about.
inline constexpr double k_rays_of_pilots = 160, k_faces_per_ray = 8;

// The estimate: a picture against the reference at some of its pixels.

/// Standard errors in a bound.
inline constexpr double k_standard_errors = 3;
/// Pixels of the first look, and of all.
inline constexpr std::size_t k_first_pixels = 48, k_most_pixels = 3072;
/// Sides of the truth's grids of rays, one after the other: none is a level of the reference, whose
/// picture would share its rays.
inline constexpr std::array k_truth_sides{4, 5, 7, 11, 15, 22, 32, 46};
/// Weight below which the truth's paths end.
inline constexpr double k_truth_cut = 0.01;
/// Below this tolerance truth and pictures take more wavelengths and larger trees.
inline constexpr double k_fine_tolerance = 0.02;
/// Trees that branch play roulette below this weight, and above the other follow both branches: the
/// quickest way to little noise is to follow few branches where few rays do.
constexpr double tree_cut(double tolerance) {
    return tolerance < k_fine_tolerance ? 0.01 : 0.04;
}
constexpr double tree_split(double tolerance) {
    return tolerance < k_fine_tolerance ? 0.3 : 0.6;
}
/// While noise is half of what is seen, a step may cost so many times as much: no other picture
/// could be shown to be near enough.
inline constexpr double k_noisy_price = 12;
/// Of the pixels, those chosen evenly; the rest go to contrast and to edges of bright lights.
inline constexpr double k_even_share = 0.4;
/// Lights so many times as bright as the picture are looked for where it lacks them (a sun:
/// a hundred times as bright as these).
inline constexpr double k_bright = 8;
/// A pixel with so much of the picture's light, and 30 times its mean, is looked at for certain.
inline constexpr double k_outlier_share = 1.0 / 24;
inline constexpr std::size_t k_most_outliers = 96;

// The scan for edges of bright lights (light_edge_scan.h).

/// Pixels along a cell, by beams, whose regions all are seen; else cells of a ray each, so many.
inline constexpr int k_cell = 3, k_scanned_pixels = 1000;
/// Pixels across the stone that do: in larger pictures what is seen is larger, too.
inline constexpr double k_across = 200;
/// Cells that may be off by most are looked at again, and then fewer, at more wavelengths.
struct CloserLook {
    std::size_t cells;
    int wavelengths;
};
inline constexpr std::array<CloserLook, 2> k_closer{{{512, 8}, {96, 29}}};
/// Paths below this weight are left to the even choice of pixels; for a sun, a hundredth of it.
inline constexpr double k_cut_weight = 0.01;

// Levels of refinement.

/// What the next picture aims at: the nearer to the tolerance, the more pixels decide.
inline constexpr double k_aim = 0.5;
/// Borders of the first beams; at each level, borders and the weights at which paths end are so
/// much finer. Errors fall as the root of borders (docs/engines.md), and about halve.
inline constexpr double k_coarsest = 0.1, k_finer_borders = 0.25, k_finer_paths = 1.0 / 3;
inline constexpr int k_most_levels_at_once = 3;
/// A crystal's paths end without roulette at k tolerance^(1/0.6): 0.009 left 0.047 of the light.
inline constexpr double k_crystal_cut = 0.32, k_crystal_power = 0.6;
/// Price of beams over that of a preview.
inline constexpr double k_price_over_preview = 2.2;
/// The reference's levels.
struct ReferenceLevel {
    int rays, wavelengths;
};
inline constexpr std::array<ReferenceLevel, 9> k_reference_levels{
    {{1, 3}, {4, 8}, {9, 29}, {36, 57}, {64, 57}, {144, 57}, {256, 57}, {576, 57}, {1600, 57}}};
/// What the mean of N rays is off by falls as N to this power (grids: 0.75; trees less).
inline constexpr double k_power_of_rays = 0.7;
/// Images of a sun: of the angle by which colours part, what three wavelengths are off by.
inline constexpr double k_sun_apart = 0.8, k_share_of_sun = 0.2;
/// Pictures of one set of effects; with a crystal's two waves merged for a try.
inline constexpr int k_most_drawings = 7, k_most_merged = 3;
/// What effects that were left out may be off by before they come back.
inline constexpr double k_misjudged = 0.7;
/// What a step of a check may cost, over the picture; after the last picture.
inline constexpr double k_check_share = 1.5, k_last_check_share = 6;

// The time budget.

/// The first tolerance; work rises as so a power of its inverse.
inline constexpr double k_first_tolerance = 0.2, k_power_of_work = 1.5;
/// Of the work that is left, what the next picture may take by what is known.
inline constexpr double k_share_of_rest = 0.8;
/// Where objects stand around the stone: pixels at which work is counted, and rays of one at most.
inline constexpr int k_counted_pixels = 256, k_most_samples = 4096;

}  // namespace culet
