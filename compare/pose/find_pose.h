#pragma once
// Finds the camera that took a photograph, from the stone's solid and a rough camera. The public
// interface of compare/pose: plain data in and out.
//
// Uses only the outline and the visible facets' edges (mostly the crown's), never internal
// reflexes, which are what a comparison is about. Most edges in a photograph of a gem are neither:
// they belong to facets of the far side, seen through the near ones. So a wireframe edge counts
// only if the photograph has an edge along most of it, and a pose counts only if it meets more
// edges than the same wireframe does at other places.
//
// Angles in radians, lengths in the stone's unit. Positions are pixels of the photograph with the
// corner of the first pixel at (0, 0) (EyeRays), x to the right, y down.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"
#include "stone/solid/solid.h"

namespace culet {

/// 99 % uncertainty of a view, radians (2 degrees), up to which it needs no look at the picture.
constexpr double k_sure_pose = 2 * 3.14159265358979323846 / 180;

/// Limits beyond which a pose is refused. docs/registration.md derives them.
struct PoseLimits {
    /// 99 % uncertainty of the view's angle to the stone, radians (10 degrees), and of the stone's
    /// place in the picture; 0: 3 % of the diameter, or a pixel. Wide, because a pose states its
    /// own uncertainty.
    double angle = 0.1745;
    double shift_px = 0;
    /// Median distance of the outline from the photograph's, as a share of the diameter.
    double outline_residual = 0.01;
    /// Probability that the edges are met by chance, or that another view is right.
    double error_probability = 0.001;
};

struct PoseOptions {
    double search = 0.61;   ///< the start's view may be off by this angle (35 degrees) ...
    bool all_turns = true;  ///< ... besides any turn about the stone's z axis
    /// Also tries the photograph mirrored left to right. For a stone with mirror symmetry only
    /// facet errors tell which it is, and a small picture does not show them.
    bool both_chiralities = false;
    /// Standard uncertainty of the model's facet tilts (angle to the true facet), 0.2 degrees. It
    /// contributes to the pose's uncertainty.
    double facet_error = 0.0035;
    /// Relative standard uncertainty of the start's focal length (perspective cameras): where a
    /// distant photograph does not show perspective, this prior alone fixes it.
    double focal_error = 0.2;
    /// Standard uncertainty of the start's principal point, share of the picture's width; 0: fixed.
    double principal_point_error = 0;
    PoseLimits limits;
    int threads = 0;  ///< 0: all processors; the result does not depend on it
};

/// One edge point that was searched: `at` is where the pose predicts it, `normal` points away from
/// the stone or from the edge's first facet.
struct EdgeMark {
    std::array<double, 2> at{}, normal{};
    std::optional<double> offset_px;  ///< to the photograph's edge along `normal`; empty: none
    bool outline = false;             ///< false: of the crown
    bool counted = false;             ///< near enough to the prediction to count
};

struct TriedPose {
    Camera camera;
    bool mirrored = false;
    double turn = 0;  ///< angle to the chosen pose
    double lead = 0;  ///< log-likelihood of the chosen pose minus this one's
    /// Looks the same except for small irregularities.
    bool symmetric = false;
    double log_odds = 0;     ///< as CrownEvidence
    double start_angle = 0;  ///< from the start's view
};

/// The evidence of whole crown edges (edge_evidence.h).
struct CrownEvidence {
    int looked = 0, met = 0;  ///< crown edges
    double chance_share = 0;  ///< share of their length that shifted edges meet
    /// Log-likelihood ratio of the edges met, the stone's against chance. Treats edges as
    /// independent and ignores the number of places tried.
    double log_odds = 0;
    /// Root mean square distance of the photograph's edges from the wireframe edges that they meet,
    /// in expected sigmas of facet errors and picture.
    double misfit = 0;
};

struct PoseSigmas {
    /// About the picture's x, y and the line of sight, radians.
    std::array<double, 3> turn{};
    double angle = 0;  ///< root sum of squares of `turn`
    /// 99 %; the effect of mistaken edges is measured, not derived.
    double angle_99 = 0, shift_99_px = 0;
    std::array<double, 2> shift_px{};
    double scale = 0;            ///< relative, of the stone's size in the picture
    double focal = 0;            ///< relative, of the focal length; 0: orthographic
    double principal_point = 0;  ///< pixels; 0: fixed
};

struct FoundPose {
    /// Its render matches the photograph, flipped left to right if `mirrored`.
    Camera camera;
    bool mirrored = false;
    bool chirality_known = true;  ///< false: both were tried, and the stone looks alike in both
    int look_alikes = 0;          ///< other views that fit as well, by the stone's symmetry
    PoseSigmas sigmas;
    double start_angle = 0;  ///< from the start's view to the found one
    double start_scale = 1;  ///< found size over the start's size
    /// Median distances of the outline and of the crown's counted edges.
    double outline_px = 0, crown_px = 0;
    double crown_support = 0, chance_support = 0;  ///< shares of the crown's edge points met
    double support_z = 0;
    CrownEvidence evidence;
    double error_probability = 1;  ///< as in PoseLimits
    /// The view's sigma from the normal equations, and from the jackknife.
    double angle_by_edges = 0, angle_by_groups = 0;
    /// Facet errors of the model estimated from the edges, one sigma: tilt as in PoseOptions, and
    /// offset of the planes at their facets' middles, a length.
    double facet_error = 0, facet_offset = 0;
    double diameter_px = 0;         ///< of the circle with the outline's area
    std::string outline_source;     ///< "mask", "coverage" or "background"
    std::vector<TriedPose> others;  ///< best first
    std::vector<EdgeMark> marks;
    std::vector<std::string> warnings;
    std::string trouble;  ///< why the pose should not be used; empty when it may be
    std::string remedy;   ///< what to do about it, in a sentence or two

    bool usable() const { return trouble.empty(); }
};

/// `start`: the best guess. Its focal length counts (see `focal_error`); its distance and the
/// stone's place do not, because the outline gives them. An orthographic start stays orthographic.
/// The result has the photograph's `width` and `height`. Throws InputError for a solid that is not
/// convex and closed, a conoscope's camera, or a mask of another size; Interrupted. If no view is
/// found, see `trouble`.
FoundPose find_pose(const Photo& photo, const Solid& solid, const Camera& start,
                    const PoseOptions& options = {}, const Progress& progress = {});

/// A PNG file: the photograph with the pose's wireframe and the distances of the met edges.
std::string pose_overlay(const Photo& photo, const Solid& solid, const FoundPose& pose);

/// One JSON object (schema 1) without the marks.
std::string pose_json(const FoundPose& pose);

/// For people, a sentence each: how sure the pose is, and what to look at; or why it is refused,
/// and what to do.
std::vector<std::string> pose_words(const FoundPose& pose);

/// The [camera] keys of a scene file as overrides (`read_scene`): "camera.position=[1, 2, 3]", ...
/// `without`: which of `fov`, `orthographic_width` and `principal_point` must be left out.
struct CameraSettings {
    std::vector<std::string> overrides, without;
};
CameraSettings camera_settings(const Camera& camera);

}  // namespace culet
