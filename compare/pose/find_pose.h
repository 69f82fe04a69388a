#pragma once
// Where the camera stood: from a photograph, the stone's solid and a rough camera to the camera
// that took it. Plain data in and out; the front door of compare/pose.
//
// What is looked at are edges between facets and air: the outline, and the edges of the facets that
// the camera sees (the crown's, mostly). Reflexes inside are what a comparison is about and are
// never used. A photograph of a gem is full of edges that belong to neither (facets of the far side
// seen through the near ones): an edge counts where it lies along the whole wireframe, and a pose
// where its wireframe is met by more edges than the same wireframe laid elsewhere.
//
// Angles are radians, lengths the stone's unit, positions pixels of the photograph with the corner
// of the first pixel at (0, 0) (EyeRays), x to the right, y down.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"
#include "stone/solid/solid.h"

namespace culet {

/// A pose is refused beyond these: see docs/registration.md for what they are derived from.
struct PoseLimits {
    /// How sure a pose must be, at 99 %: the view's angle to the stone, radians (10 degrees), and
    /// the stone's place in the picture; 0: 3 % of the stone's diameter, or a pixel. They are wide:
    /// what a pose is worth is what it states. Who needs more asks for more.
    double angle = 0.1745;
    double shift_px = 0;
    /// Median distance of the outline from the photograph's, as a share of the diameter.
    double outline_residual = 0.01;
    /// Chance that the pose is a wrong one: that its edges are met by chance, or that another view
    /// is the right one.
    double doubt = 0.001;
};

struct PoseOptions {
    double search = 0.61;   ///< the start's view may be off by this angle (35 degrees) ...
    bool all_turns = true;  ///< ... besides any turn about the stone's z axis
    /// Try the photograph mirrored left to right, too. Of a stone that looks alike in a mirror the
    /// facets' errors alone tell which it is, and a small picture does not show them.
    bool both_chiralities = false;
    /// One standard deviation of the model's facet tilts, angle to the true facet: the edges'
    /// errors that follow from it are part of the uncertainty. 0.2 degrees.
    double facet_error = 0.0035;
    /// Relative standard deviation of the start's focal length (perspective cameras): a photograph
    /// from far away does not tell it from the distance, and then this prior stands.
    double focal_error = 0.2;
    /// Standard deviation of the start's principal point, as a share of the picture's width; 0: it
    /// is taken as given.
    double principal_point_error = 0;
    PoseLimits limits;
    int threads = 0;  ///< 0: all processors; the result does not depend on it
};

/// One edge point that was looked for: `at` is where the pose puts it, `normal` points away from
/// the stone or from the edge's first facet.
struct EdgeMark {
    std::array<double, 2> at{}, normal{};
    std::optional<double> offset_px;  ///< to the photograph's edge along `normal`; none found
    bool outline = false;             ///< of the outline; else of the crown
    bool counted = false;             ///< near enough to the prediction to count
};

/// A pose that was tried to the end.
struct TriedPose {
    Camera camera;
    bool mirrored = false;
    double turn = 0;  ///< angle to the pose that was chosen
    double lead = 0;  ///< how much less likely than the chosen one (natural logarithm)
    /// The stone looks the same from here but for its small irregularities.
    bool symmetric = false;
    double log_odds = 0;     ///< as CrownEvidence
    double start_angle = 0;  ///< from the start's view
};

/// What whole edges of the crown say (edge_evidence.h).
struct CrownEvidence {
    int looked = 0, met = 0;  ///< crown edges
    double chance_share = 0;  ///< of their length, laid elsewhere
    /// Natural logarithm of how much likelier what is met is with the stone's edges there than by
    /// chance. Edges are independent witnesses; that many places were tried is not in it.
    double log_odds = 0;
    /// How far the photograph's edges lie from those that were met, over what is expected of the
    /// model's facets and of the picture there: root mean square.
    double misfit = 0;
};

struct PoseSigmas {
    /// About the picture's x, y and the line of sight, radians.
    std::array<double, 3> turn{};
    double angle = 0;  ///< root of the sum of their squares
    /// Meant to hold in 99 of 100 cases; what mistaken edges add is measured, not derived.
    double angle_99 = 0, shift_99_px = 0;
    std::array<double, 2> shift_px{};
    double scale = 0;            ///< relative, of the stone's size in the picture
    double focal = 0;            ///< relative, of the focal length; 0: orthographic
    double principal_point = 0;  ///< pixels; 0: taken as given
};

struct FoundPose {
    /// Draws the photograph: `render` with this camera lies on it. Where `mirrored`, on the
    /// photograph turned left to right.
    Camera camera;
    bool mirrored = false;
    bool chirality_known = true;  ///< false: both were tried, and the stone looks alike in both
    int look_alikes = 0;  ///< other views that explain the photograph as well, by its symmetry
    PoseSigmas sigmas;
    double start_angle = 0;  ///< from the start's view to the one found
    double start_scale = 1;  ///< size found over the start's size
    /// Median distance to the photograph's edges, of the outline and of the crown's edges that
    /// count.
    double outline_px = 0, crown_px = 0;
    double crown_support = 0, chance_support = 0;  ///< shares of the crown's edge points met
    double support_z = 0;
    CrownEvidence evidence;
    double doubt = 1;  ///< as in PoseLimits
    /// The view's sigma by the normal equations, and by groups of edges (`variances_by_groups`).
    double angle_by_edges = 0, angle_by_groups = 0;
    /// Of the model as the edges show it: tilt as in PoseOptions, and how far planes lie off at
    /// their facets' middles, a length. One sigma.
    double facet_error = 0, facet_offset = 0;
    double diameter_px = 0;         ///< of the circle of the outline's area
    std::string outline_source;     ///< "mask", "coverage" or "background"
    std::vector<TriedPose> others;  ///< best first
    std::vector<EdgeMark> marks;
    std::vector<std::string> warnings;
    std::string trouble;  ///< why it should not be used; empty when all is well
    std::string remedy;   ///< what to do about it: a sentence or two

    bool usable() const { return trouble.empty(); }
};

/// `start`: as near as is known. Its focal length counts (see `focal_error`), its distance and the
/// place of the stone in the picture do not: they are taken from the outline. An orthographic start
/// stays orthographic. The start's `width` and `height` may differ from the photograph's; the
/// result has the photograph's. Throws InputError for a solid that is not convex and closed, a
/// conoscope's camera, or a mask of another size; Interrupted when `progress` says so. A view that
/// cannot be found is no exception: see `trouble`.
FoundPose find_pose(const Photo& photo, const Solid& solid, const Camera& start,
                    const PoseOptions& options = {}, const Progress& progress = {});

/// The photograph with the wireframe of the pose in colour, and the distances of the edges that
/// were met: a PNG file's bytes.
std::string pose_overlay(const Photo& photo, const Solid& solid, const FoundPose& pose);

/// One JSON object (schema 1) with all of it but the marks.
std::string pose_json(const FoundPose& pose);

/// The [camera] keys of a scene file as overrides (`read_scene`): "camera.position=[1, 2, 3]", ...;
/// beside them, of `fov`, `orthographic_width` and `principal_point`, those that must be left out.
struct CameraSettings {
    std::vector<std::string> overrides, without;
};
CameraSettings camera_settings(const Camera& camera);

}  // namespace culet
