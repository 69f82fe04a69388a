#pragma once
// The numbers of the model: unit, meaning, and where each comes from. Lengths are in half
// diameters, gains in chi-square; numbers without a bench lie far between the two sizes that they
// tell apart. Private to the room.

namespace culet {

/// How the mesh stands (model.h, azimuth_turn.h).
struct FrameConstants {
    /// A stone is drawn standing on an axis of its file; within this of one, the tilt is a slip of
    /// hand.
    double snap_deg = 20;
    /// Facets within this of upright are the girdle's; no crown or pavilion facet comes near.
    double girdle_tilt_deg = 10;
    int width_directions = 36;  ///< of a width in plan: 5 degrees apart
    /// Of the mesh's own frame one is surer than of any drawing: five sigmas.
    double sure_turn = 5;
    /// So few differences say nothing of how they scatter.
    int least_differences = 3;
};
inline constexpr FrameConstants k_frame;

/// Shapes and formulas (model.h, residuals.h, parameters.h).
struct ShapeConstants {
    /// Held less than twice as tightly by the readings as by the mesh: not determined. In
    /// information.
    double determined = 4;
    /// For the question what is open, a reading is tight enough at this weight: squares of larger
    /// ones would drown a weight of one in rounding.
    double tight = 1e6;
    /// What the point of a meet that was let go weighs in a metric, of what others do.
    double loose_point = 0.08;
    /// Exact meets come out of the planes as edges of rounding length; real edges are longer than
    /// this part of the half diameter by far.
    double rounding_edge = 1e-10;
    /// Softening of incidences that are released: they come apart by this much of the half diameter
    /// before the point that stands for them lags behind.
    double released_sigma = 0.2;
    /// Sine between planes below which rounding has half the digits of the line they share.
    double one_plane = 1e-8;
    /// Radians: further off, some azimuths would be wrapped to the other side.
    double farthest_azimuth = 3;
    /// What a step of one means: a mesh may be off by 20 % of its width in its points; tilts,
    /// offsets and extras are of the order of one.
    double point_weight = 1 / (0.4 * 0.4);
    /// Of an edge's length: planes whose sine is less are told apart by less than the edge's ends
    /// are.
    double nearly_one_plane = 0.3;
};
inline constexpr ShapeConstants k_shapes;

/// The prior of the facets (prior.h).
struct PriorConstants {
    /// By how much facets of a well cut stone miss a common corner, as part of its width.
    double meet_miss = 0.001;
    /// Facets of a tier differ by less than a tier does from the catalogue: a dop is set once a
    /// tier. Of a hand-made mesh each facet is off by itself.
    double facets_of_design = 0.3, facets_of_drawing = 1;
    /// Below this a facet is level, and its azimuth says nothing.
    double level_deg = 5;
    /// A tier of a drawing whose angles lie within so many of its sigmas is meant to have one
    /// angle.
    double meant_alike = 6;
    /// How many observations the stated sigmas count for.
    double facets_count = 2, tiers_count = 1;
    /// However alike the readings are: no stone is cut ten times better than supposed.
    double least_part = 0.1;
};
inline constexpr PriorConstants k_prior;

}  // namespace culet
