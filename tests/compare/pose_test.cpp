// The camera of a photograph: formulas against each other, and simulated photographs from a known
// camera. bench_pose measures the full figures (docs/registration.md).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"
#include "compare/pose/changed_view.h"
#include "compare/pose/edge_search.h"
#include "compare/pose/edge_support.h"
#include "compare/pose/find_pose.h"
#include "compare/pose/outline_shape.h"
#include "compare/pose/pose_solver.h"
#include "compare/pose/same_look.h"
#include "compare/pose/stone_view.h"
#include "render/beams/screen_view.h"
#include "render/render.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/stone.h"
#include "stone/text/errors.h"
#include "tests/compare/simulated_photo.h"

namespace culet {
namespace {

synthetic::Standpoint standpoint(double tilt_deg, double diameters, int size) {
    synthetic::Standpoint place;
    place.tilt = radians(tilt_deg);
    place.azimuth = 0.7;
    place.roll = 0.4;
    place.diameters = diameters;
    place.off_x = 0.03;
    place.off_y = -0.02;
    place.size = size;
    return place;
}

std::vector<Camera> several_cameras(const Solid& solid) {
    std::vector<Camera> cameras;
    for (const double diameters : {0.0, 3.0, 20.0})
        cameras.push_back(synthetic::camera_at(solid, standpoint(25, diameters, 300)));
    cameras[1].principal_point = {210.0, 95.5};
    cameras[2].principal_point = {-40.0, 500.0};
    return cameras;
}

// The renderer's ray through the picture point passes through the point of the stone.
TEST(StoneView, SeesPointsWhereTheRendererDoes) {
    const Solid solid = make_cut("oval");
    for (const Camera& camera : several_cameras(solid)) {
        const StoneView view = stone_view(camera, centroid(solid));
        const EyeRays rays(camera);
        for (const Vec3& vertex : solid.vertices) {
            const PicturePoint at = Projection(view)(vertex);
            const EyeRay ray = rays.through(at.x, at.y);
            const Vec3 off = glm::cross(ray.direction, vertex - ray.origin);
            EXPECT_LT(glm::length(off), 1e-9);
        }
    }
}

TEST(StoneView, AndCameraAreTheSameThing) {
    const Solid solid = make_cut("oval");
    for (const Camera& camera : several_cameras(solid)) {
        const StoneView view = stone_view(camera, centroid(solid));
        const Camera back = camera_of(view, camera);
        EXPECT_LT(glm::length(back.position - camera.position), 1e-9);
        const StoneView again = stone_view(back, centroid(solid));
        for (const Vec3& vertex : solid.vertices) {
            EXPECT_NEAR(Projection(again)(vertex).x, Projection(view)(vertex).x, 1e-9);
            EXPECT_NEAR(Projection(again)(vertex).y, Projection(view)(vertex).y, 1e-9);
        }
    }
}

TEST(PrincipalPoint, CutsAPartOutOfALargerPicture) {
    for (const bool orthographic : {false, true}) {
        Camera large;
        large.width = 200;
        large.height = 160;
        if (orthographic) large.orthographic_width = 8;
        Camera part = large;
        part.width = 60;
        part.height = 50;
        part.principal_point = {100.0 - 90, 80.0 - 70};
        if (orthographic) {
            part.orthographic_width = 8.0 * 60 / 200;
        } else {
            part.fov = 2 * std::atan(std::tan(large.fov / 2) * 50 / 160);
        }
        const EyeRay a = EyeRays(large).through(90 + 17.5, 70 + 31.5);
        const EyeRay b = EyeRays(part).through(17.5, 31.5);
        EXPECT_LT(glm::length(a.origin - b.origin), 1e-12);
        EXPECT_LT(glm::length(a.direction - b.direction), 1e-12);
        const ScreenView beams = screen_view(part);
        EXPECT_LT(glm::length(glm::normalize(beams.towards({17.5, 31.5})) - b.direction), 1e-12);
    }
}

// Expectation: the orders of the cuts' point groups (C8v, C2v, Cs, C3v).
TEST(Symmetry, OfAModelIsFoundToTheLastTurn) {
    EXPECT_EQ(symmetries_of(WireSolid(make_cut("round-brilliant"))).size(), 16u);
    EXPECT_EQ(symmetries_of(WireSolid(make_cut("step"))).size(), 4u);
    EXPECT_EQ(symmetries_of(WireSolid(make_cut("pear"))).size(), 2u);
    EXPECT_EQ(symmetries_of(WireSolid(make_cut("trillion"))).size(), 6u);
}

TEST(Symmetry, IsGoneWhenFacetsAreOff) {
    std::mt19937_64 random(5);
    const Solid solid = synthetic::tilted_facets(make_cut("step"), radians(0.3), random);
    EXPECT_EQ(symmetries_of(WireSolid(solid)).size(), 1u);
}

// Expectation: the step's position, drawn in linear light and blurred by a known Gaussian.
TEST(EdgeSearch, FindsAStepToATwentiethOfAPixel) {
    for (const double place : {20.0, 20.21, 20.5, 20.83}) {
        cv::Mat picture(40, 40, CV_32FC3);
        for (int y = 0; y < 40; ++y) {
            for (int x = 0; x < 40; ++x) {
                const double share =
                    0.5 * std::erfc((x + 0.5 - place) / (0.8 * std::numbers::sqrt2));
                const float value = static_cast<float>(0.05 + 0.9 * share);
                picture.at<cv::Vec3f>(y, x) = {value, value, value};
            }
        }
        WirePoint point;
        point.at = {19.0, 20.0};
        point.normal_x = 1;
        const auto found = edges_across(EdgePicture(picture, 0), point, 4);
        ASSERT_EQ(found.size(), 1u);
        EXPECT_NEAR(19.0 + found[0].offset, place, 0.05);
    }
}

TEST(EdgeSearch, FindsNothingInAPlainPicture) {
    const cv::Mat picture(40, 40, CV_32FC3, cv::Scalar(0.3, 0.3, 0.3));
    WirePoint point;
    point.at = {20, 20};
    point.normal_y = 1;
    EXPECT_TRUE(edges_across(EdgePicture(picture, 1), point, 6).empty());
}

// Expectation: the changed view's own projection, and its differences.
TEST(ChangedView, SeesPointsAsTheViewDoesAndKnowsHowTheyMove) {
    const Solid solid = make_cut("oval");
    const ViewChange change{0.02, -0.03, 0.05, 2, -3, 0.04, 0.1, 1.5, -0.5};
    for (const Camera& camera : several_cameras(solid)) {
        const StoneView view = stone_view(camera, centroid(solid));
        ChangedView formulas(view);
        formulas.set(change);
        const Vec3 point = solid.vertices[5];
        const SeenPoint seen = formulas(point);
        const auto at = [&](const ViewChange& c, const Vec3& p) {
            return Projection(changed(view, c))(p);
        };
        EXPECT_NEAR(seen.at.x, at(change, point).x, 1e-9);
        EXPECT_NEAR(seen.at.y, at(change, point).y, 1e-9);
        // Central differences are good to h squared and to rounding error over h.
        constexpr double h = 1e-5;
        for (std::size_t k = 0; k < change.size(); ++k) {
            ViewChange more = change, less = change;
            more[k] += h;
            less[k] -= h;
            const PicturePoint a = at(more, point), b = at(less, point);
            EXPECT_NEAR(seen.x_by_change[k], (a.x - b.x) / (2 * h), 1e-5) << k;
            EXPECT_NEAR(seen.y_by_change[k], (a.y - b.y) / (2 * h), 1e-5) << k;
        }
        for (int k = 0; k < 3; ++k) {
            Vec3 step(0);
            step[k] = h;
            const PicturePoint a = at(change, point + step), b = at(change, point - step);
            EXPECT_NEAR(seen.x_by_point[k], (a.x - b.x) / (2 * h), 1e-5) << k;
            EXPECT_NEAR(seen.y_by_point[k], (a.y - b.y) / (2 * h), 1e-5) << k;
        }
    }
}

// Both changed planes contain the moved point; its slopes are its differences.
TEST(MovedEdge, IsWhereTheChangedFacetsMeet) {
    const WireSolid wire(make_cut("step"));
    const std::array<FacetChange, 2> changes{FacetChange{0.02, -0.03, 0.01},
                                             FacetChange{-0.015, 0.04, -0.02}};
    for (const Edge& edge : wire.edges) {
        const FacetFrame left = frame_of(wire, edge.left), right = frame_of(wire, edge.right);
        const Vec3& from = wire.solid.vertices[static_cast<std::size_t>(edge.from)];
        const Vec3& to = wire.solid.vertices[static_cast<std::size_t>(edge.to)];
        const Vec3 point = 0.3 * from + 0.7 * to;
        const auto moved = [&](const std::array<FacetChange, 2>& c) {
            return moved_edge(left, right, point, c[0].data(), c[1].data());
        };
        const MovedEdge found = moved(changes);
        for (int side = 0; side < 2; ++side) {
            const FacetFrame& frame = side == 0 ? left : right;
            const FacetChange& c = changes[static_cast<std::size_t>(side)];
            const Vec3 normal = frame.normal + c[0] * frame.across + c[1] * frame.along;
            EXPECT_NEAR(glm::dot(normal, found.at - frame.middle), c[2], 1e-12);
        }
        for (std::size_t k = 0; k < 6; ++k) {
            constexpr double h = 1e-6;
            auto more = changes, less = changes;
            more[k / 3][k % 3] += h;
            less[k / 3][k % 3] -= h;
            const Vec3 slope = (moved(more).at - moved(less).at) / (2 * h);
            EXPECT_LT(glm::length(slope - found.slopes[k]), 1e-7 * (1 + glm::length(slope))) << k;
        }
    }
}

// A share of zero points must not be NaN: most other places have no point on a single edge.
TEST(EdgeSupport, OfOnePointIsANumber) {
    const cv::Mat picture(60, 60, CV_32FC3, cv::Scalar(0.3, 0.3, 0.3));
    WirePoint point;
    point.at = {30, 30};
    point.normal_x = 1;
    const EdgeSupport support = edge_support(EdgePicture(picture, 1), {point}, 40);
    EXPECT_EQ(support.met, 0);
    EXPECT_EQ(support.chance, 0);
    EXPECT_TRUE(std::isfinite(support.z));
}

// Expectation: the view whose own projection gave the edges.
TEST(PoseSolver, ReturnsToTheViewThatEdgesComeFrom) {
    const WireSolid wire(make_cut("pear"));
    for (const double diameters : {0.0, 8.0}) {
        const Camera camera = synthetic::camera_at(wire.solid, standpoint(18, diameters, 400));
        const StoneView truth = stone_view(camera, wire.middle);
        StoneView view = changed(truth, {0.02, -0.015, 0.01, 3, -2, 0.02, 0.02, 0, 0});
        for (int round = 0; round < 6; ++round) {
            std::vector<MetEdge> met;
            for (const WirePoint& point : points_along(wire, view, {})) {
                const PicturePoint there = Projection(truth)(point.on_stone);
                met.push_back({point,
                               (there.x - point.at.x) * point.normal_x +
                                   (there.y - point.at.y) * point.normal_y,
                               0.1});
            }
            view = solve_view(wire, view, met, truth.focal_px(), truth.sight, {}).view;
        }
        EXPECT_LT(angle_of(view.turn * glm::transpose(truth.turn)), 1e-6);
        EXPECT_NEAR(view.at.x, truth.at.x, 1e-4);
        EXPECT_NEAR(view.at.y, truth.at.y, 1e-4);
        EXPECT_NEAR(view.scale / truth.scale, 1, 1e-6);
    }
}

// Expectation: size and place of the view from which the mask was painted. A mask's pixels are
// known to half a pixel each, and 72 tangents average that.
TEST(OutlineShape, GivesSizeAndPlace) {
    const WireSolid wire(make_cut("oval"));
    const Camera camera = synthetic::camera_at(wire.solid, standpoint(15, 0, 400));
    const StoneView truth = stone_view(camera, wire.middle);
    std::vector<cv::Point> corners;
    constexpr int k_shift = 8;
    for (const Vec3& vertex : wire.solid.vertices) {
        const PicturePoint p = Projection(truth)(vertex);
        corners.emplace_back(static_cast<int>(std::lround((p.x - 0.5) * (1 << k_shift))),
                             static_cast<int>(std::lround((p.y - 0.5) * (1 << k_shift))));
    }
    std::vector<cv::Point> hull;
    cv::convexHull(corners, hull);
    cv::Mat mask = cv::Mat::zeros(400, 400, CV_8U);
    cv::fillConvexPoly(mask, hull, cv::Scalar(255), cv::LINE_8, k_shift);
    StoneView start = truth;
    start.scale *= 0.8;
    start.at = {200, 200};
    const FittedOutline fitted = fit_outline(wire, outline_shape(mask), start, 0);
    EXPECT_NEAR(fitted.view.scale / truth.scale, 1, 0.005);
    EXPECT_NEAR(fitted.view.at.x, truth.at.x, 0.5);
    EXPECT_NEAR(fitted.view.at.y, truth.at.y, 0.5);
    EXPECT_LT(fitted.rms, 0.6);
}

struct Shot {
    Solid model;
    Scene scene;
    Photo photo;
};

Shot shot(const std::string& cut, double facet_deg, double tilt_deg, double diameters,
          const std::string& light, int size, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Shot made;
    made.model = make_cut(cut);
    made.scene.stone.solid = synthetic::tilted_facets(made.model, radians(facet_deg), random);
    made.scene.stone.material = catalogue_material("diamond");
    made.scene.camera = synthetic::camera_at(made.model, standpoint(tilt_deg, diameters, size));
    made.scene.lights = synthetic::named_lights(light);
    made.scene.settings.engine = "beams";
    made.scene.settings.tolerance = 0.03;
    made.photo = synthetic::photographed(render(made.scene).picture, {}, random);
    return made;
}

Camera rough_start(const Shot& made, double angle_deg, double scale, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    return synthetic::disturbed(made.scene.camera, made.model, radians(angle_deg), scale, random);
}

double angle_to_truth(const Shot& made, const FoundPose& pose, int fold) {
    const Vec3 middle = centroid(made.model);
    const glm::dmat3 truth = stone_view(made.scene.camera, middle).turn;
    const glm::dmat3 found = stone_view(pose.camera, middle).turn;
    double least = 10;
    for (int k = 0; k < fold; ++k) {
        const glm::dmat3 symmetric = rotation_by({0, 0, 2 * std::numbers::pi * k / fold});
        least = std::min(least, angle_of(found * symmetric * glm::transpose(truth)));
    }
    return least;
}

double shift_to_truth(const Shot& made, const FoundPose& pose) {
    const Vec3 middle = centroid(made.model);
    const PicturePoint a = stone_view(made.scene.camera, middle).at;
    const PicturePoint b = stone_view(pose.camera, middle).at;
    return std::hypot(a.x - b.x, a.y - b.y);
}

// Expectation: the camera that took the picture, within the 99 % that the pose states.
TEST(FindPose, FindsTheCameraOfABrilliantFrom25DegreesAway) {
    const Shot made = shot("round-brilliant", 0.2, 20, 12, "overcast", 320, 11);
    PoseOptions options;
    options.both_chiralities = true;
    options.limits.angle = radians(1);
    options.limits.shift_px = 1;
    const FoundPose pose =
        find_pose(made.photo, made.model, rough_start(made, 25, 1.18, 3), options);
    EXPECT_TRUE(pose.usable()) << pose.trouble;
    EXPECT_FALSE(pose.mirrored);
    EXPECT_FALSE(pose.chirality_known);  // a brilliant equals its mirror image
    EXPECT_EQ(pose.others.size(), 15u + static_cast<std::size_t>(std::count_if(
                                            pose.others.begin(), pose.others.end(),
                                            [](const TriedPose& p) { return p.lead != 0; })));
    EXPECT_LT(angle_to_truth(made, pose, 8), pose.sigmas.angle_99);
    EXPECT_LT(shift_to_truth(made, pose), pose.sigmas.shift_99_px);
    EXPECT_LT(pose.sigmas.angle_99, radians(1));
}

// Facets with errors of 0.2 degrees leave the view uncertain by more than 0.1 degrees: the result
// says so.
TEST(FindPose, RefusesWhatItCannotPromise) {
    const Shot made = shot("trillion", 0.2, 4, 8, "dome", 240, 12);
    PoseOptions options;
    options.search = radians(12);
    options.limits.angle = radians(0.1);
    const FoundPose pose =
        find_pose(made.photo, made.model, rough_start(made, 10, 0.9, 4), options);
    EXPECT_FALSE(pose.usable());
    EXPECT_FALSE(pose.remedy.empty());
}

// A photograph from below gives no pose of the crown, although the outline is the same.
TEST(FindPose, RefusesAPhotographOfTheOtherSide) {
    Shot made = shot("round-brilliant", 0.2, 175, 12, "overcast", 320, 17);
    const Camera start = synthetic::camera_at(made.model, standpoint(5, 12, 320));
    const FoundPose pose = find_pose(made.photo, made.model, start);
    EXPECT_FALSE(pose.usable());
    EXPECT_FALSE(pose.remedy.empty());
}

// Expectation: the camera that took the whole picture, from the cropped part alone.
TEST(FindPose, FindsTheCameraOfACroppedPhotograph) {
    Shot made = shot("round-brilliant", 0.2, 20, 12, "overcast", 320, 11);
    const Camera start = rough_start(made, 15, 1.1, 3);
    made.photo = synthetic::cropped(made.photo, 30, 12, 270, 300);
    const FoundPose pose = find_pose(made.photo, made.model, start);
    EXPECT_TRUE(pose.usable()) << pose.trouble;
    EXPECT_EQ(pose.camera.width, 270);
    EXPECT_LT(angle_to_truth(made, pose, 8), pose.sigmas.angle_99);
}

TEST(FindPose, RefusesAnotherStone) {
    const Shot made = shot("pear", 0.2, 10, 12, "dome", 240, 13);
    PoseOptions options;
    options.search = radians(12);
    options.limits.angle = radians(5);
    options.limits.shift_px = 5;
    const FoundPose pose =
        find_pose(made.photo, make_cut("trillion"), rough_start(made, 5, 1, 5), options);
    EXPECT_FALSE(pose.usable());
    // The overlay still shows why.
    EXPECT_EQ(pose_overlay(made.photo, made.model, pose).substr(1, 3), "PNG");
}

TEST(FindPose, SeesThatAPhotographIsMirrored) {
    // A stone without any symmetry, and a model that knows it.
    Shot made = shot("pear", 2.5, 15, 0, "overcast", 320, 14);
    made.model = made.scene.stone.solid;
    const Camera start = rough_start(made, 8, 1.1, 6);
    Photo turned = made.photo;
    cv::Mat flipped;
    cv::flip(colour_of(made.photo), flipped, 1);
    turned.rgb.assign(flipped.ptr<float>(), flipped.ptr<float>() + made.photo.rgb.size());
    PoseOptions options;
    options.search = radians(12);
    options.limits.angle = radians(1);
    options.limits.shift_px = 1;
    // No photograph is taken as mirrored unless that is requested.
    EXPECT_FALSE(find_pose(turned, made.model, start, options).mirrored);
    options.both_chiralities = true;
    const FoundPose as_is = find_pose(made.photo, made.model, start, options);
    EXPECT_FALSE(as_is.mirrored);
    EXPECT_TRUE(as_is.chirality_known);
    const FoundPose mirrored = find_pose(turned, made.model, start, options);
    EXPECT_TRUE(mirrored.mirrored);
    EXPECT_TRUE(mirrored.chirality_known);
    EXPECT_LT(angle_to_truth(made, mirrored, 1), mirrored.sigmas.angle_99);
}

TEST(FindPose, DoesNotDependOnTheNumberOfThreads) {
    const Shot made = shot("step", 0.2, 12, 12, "overcast", 240, 15);
    PoseOptions options;
    options.search = radians(12);
    options.threads = 1;
    const Camera start = rough_start(made, 10, 0.9, 7);
    const std::string one = pose_json(find_pose(made.photo, made.model, start, options));
    options.threads = 3;
    EXPECT_EQ(one, pose_json(find_pose(made.photo, made.model, start, options)));
}

TEST(FindPose, RefusesABlackPictureAndAStoneOfTenPixels) {
    Photo photo;
    photo.width = photo.height = 64;
    photo.rgb.assign(3 * 64 * 64, 0.0f);
    const Solid solid = make_cut("step");
    const Camera camera = synthetic::camera_at(solid, standpoint(5, 0, 64));
    EXPECT_FALSE(find_pose(photo, solid, camera).usable());
    photo.mask.assign(64 * 64, 0.0f);
    for (int y = 20; y < 30; ++y)
        for (int x = 20; x < 30; ++x) photo.mask[static_cast<std::size_t>(64 * y + x)] = 1;
    EXPECT_FALSE(find_pose(photo, solid, camera).usable());
}

TEST(FindPose, AnswersAStop) {
    const Shot made = shot("step", 0, 12, 12, "overcast", 160, 16);
    EXPECT_THROW(
        find_pose(made.photo, made.model, made.scene.camera, {}, [](double) { return false; }),
        Interrupted);
}

TEST(FindPose, SaysWhatItCannotWorkWith) {
    Photo photo;
    photo.width = photo.height = 64;
    photo.rgb.assign(3 * 64 * 64, 0.5f);
    const Solid solid = make_cut("step");
    Camera camera = synthetic::camera_at(solid, standpoint(5, 0, 64));
    EXPECT_THROW(find_pose(photo, make_cut("heart"), camera), InputError);
    EXPECT_THROW(find_pose(photo, Solid{}, camera), InputError);
    photo.mask.assign(10, 1.0f);
    EXPECT_THROW(find_pose(photo, solid, camera), InputError);
    photo.mask.clear();
    camera.cone = 0.5;
    EXPECT_THROW(find_pose(photo, solid, camera), InputError);
}

}  // namespace
}  // namespace culet
