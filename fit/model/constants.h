#pragma once
// Constants of the model: unit, meaning, and the bench they come from. Lengths are in half
// diameters, gains in chi-square. A constant without a bench lies far between the two sizes that it
// separates. Private to the room.

namespace culet {

/// How the mesh stands (frame.h, azimuth_turn.h).
struct FrameConstants {
    /// A mesh is drawn upright along an axis of its file. A smaller tilt is the drawer's error.
    double snap_deg = 20;
    /// Facets within this of upright belong to the girdle; crown and pavilion facets stay far away.
    double girdle_tilt_deg = 10;
    int width_directions = 36;  ///< searched for the greatest width in plan: every 5 degrees
    /// Standard errors. The mesh is turned only by a difference that exceeds this many.
    double sure_turn = 5;
    /// With fewer differences their scatter is unknown.
    int least_differences = 3;
};
inline constexpr FrameConstants k_frame;

/// Shapes and formulas (shape.h, residuals.h, parameters.h).
struct ShapeConstants {
    /// Information, relative to the mesh's. A direction with less is undetermined: the readings
    /// hold it less than twice as tightly as the mesh.
    double determined = 4;
    /// Largest weight of a reading while undetermined directions are counted. Squares of larger
    /// weights would drown a weight of one in rounding.
    double tight = 1e6;
    /// Weight in the metric of a released meet's point, relative to other points.
    double loose_point = 0.08;
    /// Sigma that holds the motions of lines where nothing tells them, far above any real one, and
    /// their weight in the metric, so that they never count as undetermined.
    double motion_sigma = 10, loose_motion = 1e-3;
    /// Exact meets show as edges of about rounding error; real edges are far longer than this.
    double rounding_edge = 1e-10;
    /// Sigma of released incidences: planes come apart this far before the meet's point lags.
    double released_sigma = 0.2;
    /// Sine between two planes. Below it, rounding takes half the digits of their common line.
    double one_plane = 1e-8;
    /// Radians. Azimuths that differ by more could wrap to the other side.
    double farthest_azimuth = 3;
    /// Weight of a point: a mesh may be off by 20 % of its width. Tilts, offsets and extra unknowns
    /// have a weight of one.
    double point_weight = 1 / (0.4 * 0.4);
    /// Sine between two planes, over the length of their edge. Below it, the length is the distance
    /// between the edge's ends; above it, it is measured along the planes' common line.
    double nearly_one_plane = 0.3;
};
inline constexpr ShapeConstants k_shapes;

/// The prior of the facets (prior.h).
struct PriorConstants {
    /// By how much facets of a well cut stone miss a common corner, as a part of its width.
    double meet_miss = 0.001;
    /// Sigma of a facet about its tier, relative to that of a tier about the start. A cutter sets
    /// the dop once a tier; in a drawing each facet is off by itself.
    double facets_of_design = 0.3, facets_of_drawing = 1;
    /// Below this inclination a facet is level: its azimuth is meaningless.
    double level_deg = 5;
    /// In sigmas. Angles of a drawn tier that differ by less are taken as one angle.
    double meant_alike = 6;
    /// Observations that the stated sigmas count for.
    double facets_count = 2, tiers_count = 1;
    /// Least estimated sigma, relative to the stated one, however alike the readings are.
    double least_part = 0.1;
};
inline constexpr PriorConstants k_prior;

}  // namespace culet
