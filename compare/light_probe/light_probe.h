#pragma once
// The light around a mirror ball from its photographs.

#include <optional>
#include <string>
#include <vector>

#include "compare/light_probe/ball_finder.h"
#include "compare/light_probe/light_merge.h"
#include "compare/light_probe/near_light.h"
#include "compare/light_probe/view_alignment.h"
#include "compare/photo/photo.h"
#include "stone/progress/progress.h"

namespace culet {

/// One camera position, its exposures already merged (bracket.h).
struct ProbeView {
    std::string name;  ///< for messages
    Photo photo;
    std::optional<BallCircle> ball;  ///< as given; otherwise found
    double focal_px = 0;             ///< from a camera file or EXIF; 0: unknown
    std::optional<PixelPlace> principal;
};

struct ProbeOptions {
    double distance = 0;       ///< camera to ball in ball radii, may be infinite; 0: unknown
    Rgb reflectance{1, 1, 1};  ///< of the ball, 0..1
    PhotographerCone photographer;
    /// Where the first camera looked, in the stone's frame: azimuth counter-clockwise from +x,
    /// elevation over the horizontal. Looking straight down, the picture's top points to the
    /// azimuth.
    double towards_azimuth = 0, towards_elevation = 0;
    /// The second camera's rotation about the vertical of the first picture, counter-clockwise from
    /// above; otherwise found.
    std::optional<double> turned;
    int width = 0;    ///< of the lat-long map; 0: as fine as the ball shows it
    int passes = 20;  ///< of sharpening (light_merge.h)
    /// The ball was moved, not the camera: further views give only the distances of near lights.
    bool moved = false;
    /// Lights to take out of the map as windows; lengths in the stone's unit.
    std::vector<NearLightRequest> near_lights;
    double ball_radius = 0;  ///< in the stone's unit; required with near lights
};

struct ProbeViewResult {
    std::string name;
    BallCircle circle;
    double support = 1;  ///< of the outline, if it was found
    bool found = false;
    std::optional<BallCircle> rival;  ///< see FoundBall
    double distance = 0, focal_px = 0;
    std::string distance_from;  ///< "given", "focal length", "both views", "assumed"
    double gain = 1;            ///< that brings it to the first view
    double over_exposed = 0;    ///< share of the ball
    glm::dmat3 world_from_camera{1.0};
    double turned = 0;     ///< from the first view, radians
    Vec3 centre{0, 0, 0};  ///< of a ball that was moved, in ball radii, in the stone's frame
};

struct LightProbe {
    MergedLight light;  ///< radiance in the units of the first view
    std::vector<ProbeViewResult> views;
    std::vector<ViewAlignment> alignments;  ///< of the second and further views to the first
    /// Mean, median and 99 % quantile where two views see, stops.
    double mean_disagreement = 0, middle_disagreement = 0, worst_disagreement = 0;
    double covered = 0;                  ///< share of all directions
    bool moved = false;                  ///< the ball, not the camera
    std::vector<NearLight> near_lights;  ///< lengths in the stone's unit; radiance as in the map
    std::vector<std::string> notes;      ///< for people, one line each
    /// Why the result cannot be trusted; otherwise empty.
    std::string doubt;
    bool usable() const { return doubt.empty(); }
};

/// Throws InputError naming the view: no ball found (with advice), a ball outside the picture or
/// too small, or a black picture.
LightProbe light_probe(const std::vector<ProbeView>& views, const ProbeOptions& options,
                       const Progress& progress = {});

/// The `[light]` table of a scene: the environment, and the near lights as `[[light.plane]]`.
/// `environment`: its path as written in the scene.
std::string light_toml(const LightProbe& probe, const std::string& environment);

/// One JSON object with `schema`; angles in degrees.
std::string light_json(const LightProbe& probe, const ProbeOptions& options);

/// PNG: coverage above, disagreement below, each with its scale.
std::string coverage_png(const LightProbe& probe);

}  // namespace culet
