#include "compare/light/light_probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/pixels.h"
#include "render/environment_layout.h"
#include "stone/errors.h"
#include "stone/units.h"

namespace culet {

namespace {

constexpr double k_pi = std::numbers::pi;
constexpr double k_smallest_radius = 20;  // pixels
constexpr double k_usual_distance = 30;   // radii, where nothing says better
// Gains nearer to 1 than this are lamps' flicker, shutters' scatter or the error of finding them:
// exposures that differ on purpose differ by a third of a stop.
constexpr double k_rounding = 0.01;
// Pixels: an outline is no better known than this, whatever its edges' scatter says, for light
// beside and behind the ball draws them one way.
constexpr double k_least_sigma = 0.15;
constexpr int k_narrowest = 128, k_widest = 4096;

glm::dmat3 world_from_camera(double azimuth, double elevation) {
    const double ca = std::cos(azimuth), sa = std::sin(azimuth);
    const double ce = std::cos(elevation), se = std::sin(elevation);
    const Vec3 forward(ce * ca, ce * sa, se), up(-se * ca, -se * sa, ce);
    return {glm::cross(forward, up), up, -forward};
}

glm::dmat3 about_vertical(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {Vec3(c, 0, -s), Vec3(0, 1, 0), Vec3(s, 0, c)};  // columns
}

[[noreturn]] void refuse(const ProbeView& view, const std::string& message) {
    throw InputError(std::filesystem::path(view.name), message);
}

FoundBall ball_in(const ProbeView& view) {
    const Photo& photo = view.photo;
    if (view.ball) {
        const BallCircle& c = *view.ball;
        if (!(c.radius > 0) || c.x - c.radius < -1 || c.y - c.radius < -1 ||
            c.x + c.radius > photo.width || c.y + c.radius > photo.height) {
            refuse(view, fmt::format("the ball at {:g},{:g} with radius {:g} reaches outside the "
                                     "picture of {} x {} pixels: --ball is X,Y,RADIUS in pixels "
                                     "from the top left",
                                     c.x, c.y, c.radius, photo.width, photo.height));
        }
        return {c, 1, 0.25};
    }
    const std::vector<FoundBall> balls = find_balls(photo);
    for (const FoundBall& ball : balls) {
        const BallCircle& c = ball.circle;
        if (c.x - c.radius >= -1 && c.y - c.radius >= -1 && c.x + c.radius <= photo.width &&
            c.y + c.radius <= photo.height)
            return ball;
    }
    if (!balls.empty()) {
        const BallCircle& c = balls.front().circle;
        refuse(view, fmt::format("the ball (at {:.0f},{:.0f}, radius {:.0f}) reaches outside the "
                                 "picture: photograph all of it, or give it with --ball "
                                 "X,Y,RADIUS",
                                 c.x, c.y, c.radius));
    }
    refuse(view,
           "no ball found: give its middle and radius in pixels with --ball X,Y,RADIUS, or "
           "photograph it larger and against a plain ground");
}

// The picture cut to the ball and shrunk to what the map can hold; the geometry with it.
struct Prepared {
    std::shared_ptr<const Photo> picture;
    ViewPrior prior;
    double left = 0, top = 0, factor = 1;  // of the cut in the photograph

    BallCircle in_photograph(const BallCircle& c) const {
        return {(c.x + 0.5) * factor - 0.5 + left, (c.y + 0.5) * factor - 0.5 + top,
                c.radius * factor};
    }
};

std::vector<float> shrunk(const float* values, int channels, const Photo& photo,
                          const cv::Rect& cut, int factor) {
    const cv::Mat whole(photo.height, photo.width, CV_32FC(channels), const_cast<float*>(values));
    cv::Mat part = whole(cut).clone();
    if (factor > 1) {
        cv::Mat small;
        cv::resize(part, small, cv::Size(part.cols / factor, part.rows / factor), 0, 0,
                   cv::INTER_AREA);
        part = small;
    }
    const auto* first = part.ptr<float>();
    return {first, first + part.total() * static_cast<std::size_t>(channels)};
}

Prepared prepared(const ProbeView& view, const FoundBall& ball, const ProbeOptions& options,
                  int width) {
    const Photo& photo = view.photo;
    const BallCircle& c = ball.circle;
    const int factor = std::max(1, static_cast<int>(k_pi * c.radius / (2.0 * width)));
    const double margin = 2 + 0.03 * c.radius;
    cv::Rect cut;
    cut.x = std::max(0, static_cast<int>(c.x - c.radius - margin));
    cut.y = std::max(0, static_cast<int>(c.y - c.radius - margin));
    cut.width = std::min(photo.width, static_cast<int>(c.x + c.radius + margin) + 1) - cut.x;
    cut.height = std::min(photo.height, static_cast<int>(c.y + c.radius + margin) + 1) - cut.y;
    cut.width -= cut.width % factor;
    cut.height -= cut.height % factor;
    auto small = std::make_shared<Photo>();
    small->width = cut.width / factor;
    small->height = cut.height / factor;
    small->rgb = shrunk(photo.rgb.data(), 3, photo, cut, factor);
    std::vector<float> saturated = photo.saturated;
    if (saturated.empty() && photo.saturation > 0) {
        saturated.resize(photo.rgb.size() / 3);
        const auto clip = static_cast<float>(0.99 * photo.saturation);
        for (std::size_t i = 0; i < saturated.size(); ++i) {
            saturated[i] =
                std::max({photo.rgb[3 * i], photo.rgb[3 * i + 1], photo.rgb[3 * i + 2]}) >= clip;
        }
    }
    if (!saturated.empty()) small->saturated = shrunk(saturated.data(), 1, photo, cut, factor);

    Prepared result;
    result.factor = factor;
    result.left = cut.x;
    result.top = cut.y;
    const auto inside = [&](double x, double from) { return (x - from + 0.5) / factor - 0.5; };
    const PixelPlace principal =
        view.principal.value_or(PixelPlace{(photo.width - 1) / 2.0, (photo.height - 1) / 2.0});
    result.prior.circle = {inside(c.x, cut.x), inside(c.y, cut.y), c.radius / factor};
    result.prior.circle_sigma_px = std::max(k_least_sigma, 2 * ball.sigma_px) / factor;
    result.prior.principal = {inside(principal.x, cut.x), inside(principal.y, cut.y)};
    result.prior.focal_px = options.distance > 0 ? 0 : view.focal_px / factor;
    result.prior.distance = options.distance;
    result.picture = std::move(small);
    return result;
}

// Share of the ball that is over-exposed; refuses a ball in the dark.
double over_exposed(const ProbeView& view, const Photo& picture, const BallCircle& c) {
    double over = 0, pixels = 0, light = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (std::hypot(x - c.x, y - c.y) > c.radius) continue;
            const std::size_t i = static_cast<std::size_t>(y) * picture.width + x;
            ++pixels;
            if (!picture.saturated.empty()) over += picture.saturated[i];
            for (std::size_t k = 0; k < 3; ++k) light += picture.rgb[3 * i + k];
        }
    }
    if (!(light > 0)) refuse(view, "the ball is black: nothing was exposed");
    return over / std::max(pixels, 1.0);
}

// What is worth saying to people, and whether the result can be trusted.
void judge(LightProbe& probe) {
    double omega_sum = 0, covered = 0;
    std::vector<float> stops;
    double sum = 0;
    const MergedLight& light = probe.light;
    for (int y = 0; y < light.map.height; ++y) {
        const double omega = lat_long_solid_angle(y, light.map.width, light.map.height);
        for (int x = 0; x < light.map.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * light.map.width + x;
            omega_sum += omega;
            if (light.coverage[i] > 1e-4f) covered += omega;
            if (std::isfinite(light.disagreement[i])) {
                stops.push_back(light.disagreement[i]);
                sum += light.disagreement[i];
            }
        }
    }
    probe.covered = covered / omega_sum;
    if (!stops.empty()) {
        probe.mean_disagreement = sum / static_cast<double>(stops.size());
        const auto worst =
            stops.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(stops.size()));
        std::nth_element(stops.begin(), worst, stops.end());
        probe.worst_disagreement = *worst;
    }
    const double missing = 100 * (1 - probe.covered);
    if (probe.views.size() == 1) {
        probe.notes.push_back(
            fmt::format("one view: the {:.0f} degrees behind the ball are filled from around "
                        "them, and camera and photographer are still in the light; a second view "
                        "from the side mends both",
                        2 * degrees(std::asin(1 / probe.views[0].distance))));
    } else if (missing > 0.05) {
        probe.notes.push_back(
            fmt::format("{:.1f} % of all directions are seen by no view well", missing));
    }
    for (const ProbeViewResult& view : probe.views) {
        if (view.over_exposed > 1e-5) {
            probe.notes.push_back(
                fmt::format("{}: {:.2f} % of the ball is over-exposed: lights there are brighter "
                            "than found; add a shorter exposure",
                            view.name, 100 * view.over_exposed));
        }
        if (view.distance_from == "assumed") {
            probe.notes.push_back(fmt::format(
                "{}: the camera is taken to be {:g} ball radii away: say better with --distance",
                view.name, view.distance));
        }
    }
    for (const ViewAlignment& a : probe.alignments) {
        if (a.ambiguous) {
            probe.doubt = fmt::format(
                "the views do not fit together in one way only (correlation {:.2f}, "
                "the next best turn {:.2f}): say how far the camera went with "
                "--turned DEGREES, or check that both show one room",
                a.correlation, a.rival);
        }
    }
    if (probe.doubt.empty() && probe.views.size() > 1 && probe.mean_disagreement > 0.7) {
        probe.doubt = fmt::format(
            "the views differ by {:.1f} stops on average: look at the disagreement picture (did "
            "lights change or the ball move?)",
            probe.mean_disagreement);
    }
}

}  // namespace

LightProbe light_probe(const std::vector<ProbeView>& views, const ProbeOptions& options,
                       const Progress& progress) {
    if (views.empty()) throw InputError("no photograph of a ball was given");
    for (const ProbeView& view : views) {
        if (view.photo.width != views[0].photo.width ||
            view.photo.height != views[0].photo.height) {
            refuse(view, fmt::format("is {} x {} pixels, {} is {} x {}: views are whole pictures "
                                     "of one camera, not cut",
                                     view.photo.width, view.photo.height, views[0].name,
                                     views[0].photo.width, views[0].photo.height));
        }
    }
    LightProbe probe;
    std::vector<FoundBall> balls;
    double largest = 0;
    for (const ProbeView& view : views) {
        balls.push_back(ball_in(view));
        if (balls.back().circle.radius < k_smallest_radius) {
            refuse(view, fmt::format("the ball has a radius of {:.0f} pixels; at least {:.0f} are "
                                     "needed: go nearer",
                                     balls.back().circle.radius, k_smallest_radius));
        }
        largest = std::max(largest, balls.back().circle.radius);
        if (progress &&
            !progress(0.2 * static_cast<double>(balls.size()) / static_cast<double>(views.size())))
            throw Interrupted();
    }
    // A fifth more texels round the horizon than the ball has pixels for, so that none is lost; in
    // whole multiples of 128. A coarser map is the mean of such a one, a finer one is as it is.
    const int natural = std::clamp(128 * static_cast<int>(std::ceil(1.2 * k_pi * largest / 128)),
                                   k_narrowest, k_widest);
    const int coarser = options.width > 0 && options.width < natural
                            ? (natural + options.width - 1) / options.width
                            : 1;
    const int width = options.width > 0 ? coarser * options.width : natural;

    std::vector<Prepared> ready;
    std::vector<BallView> seen;
    std::vector<double> gains{1};
    for (std::size_t v = 0; v < views.size(); ++v) {
        ready.push_back(prepared(views[v], balls[v], options, width));
        ProbeViewResult result;
        result.name = views[v].name;
        result.support = balls[v].support;
        result.found = !views[v].ball;
        result.over_exposed = over_exposed(views[v], *ready[v].picture, ready[v].prior.circle);
        result.distance_from = options.distance > 0    ? "given"
                               : views[v].focal_px > 0 ? "focal length"
                               : views.size() > 1      ? "both views"
                                                       : "assumed";
        probe.views.push_back(result);
        seen.push_back({ready[v].picture, ball_of(ready[v].prior, k_usual_distance),
                        options.photographer, glm::dmat3(1.0)});
    }
    seen[0].world_from_camera =
        world_from_camera(options.towards_azimuth, options.towards_elevation);
    for (std::size_t v = 1; v < views.size(); ++v) {
        std::optional<glm::dmat3> turned;
        if (options.turned) turned = about_vertical(*options.turned);
        // To the first view; further ones, where the first shows too little in common, to others.
        std::size_t to = 0;
        std::optional<ViewAlignment> best;
        for (std::size_t candidate = 0; candidate < v; ++candidate) {
            ViewAlignment a =
                align_views(seen[candidate], ready[candidate].prior, seen[v], ready[v].prior,
                            candidate == 0 && v == 1 ? turned : std::nullopt);
            if (!best || (best->ambiguous && !a.ambiguous)) {
                best = a;
                to = candidate;
            }
            if (!best->ambiguous) break;
        }
        seen[to].ball = best->first;
        seen[v].ball = best->second;
        seen[v].world_from_camera = seen[to].world_from_camera * best->first_from_second;
        gains.push_back(gains[to] * (std::abs(best->gain - 1) < k_rounding ? 1.0 : best->gain));
        // What was refined with one view stays as it is for the next.
        ready[to].prior.circle = best->first.circle();
        ready[to].prior.circle_sigma_px = 0.02;
        if (ready[to].prior.focal_px <= 0) ready[to].prior.distance = best->first.distance();
        probe.alignments.push_back(*best);
        if (progress &&
            !progress(0.2 + 0.3 * static_cast<double>(v) / static_cast<double>(views.size() - 1)))
            throw Interrupted();
    }
    for (std::size_t v = 0; v < views.size(); ++v) {
        ProbeViewResult& result = probe.views[v];
        result.circle = ready[v].in_photograph(seen[v].ball.circle());
        result.distance = seen[v].ball.distance();
        result.focal_px = seen[v].ball.focal_px() * ready[v].factor;
        result.gain = gains[v];
        result.world_from_camera = seen[v].world_from_camera;
        const Vec3 a = seen[0].world_from_camera * seen[0].ball.towards_camera();
        const Vec3 b = seen[v].world_from_camera * seen[v].ball.towards_camera();
        result.turned = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    }
    probe.light = merge_views(seen, gains, width, options.passes,
                              [&](double done) { return !progress || progress(0.5 + 0.5 * done); });
    if (coarser > 1) probe.light = coarsened(probe.light, coarser);
    for (std::size_t i = 0; i < probe.light.map.rgb.size(); ++i)
        probe.light.map.rgb[i] /= static_cast<float>(options.reflectance[i % 3]);
    judge(probe);
    return probe;
}

}  // namespace culet
