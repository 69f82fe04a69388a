// Edges in photographs as readings: closed forms, and stones that are found again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "fit/fit.h"
#include "fit/model/equations.h"
#include "fit/model/linear.h"
#include "fit/readings/seen_lines.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using testing::HasSubstr;

constexpr double k_zoom = 100;  // pixels per unit of length

// Looks down on the origin. `nearness`: one over the distance of the eye; 0 is a parallel view.
glm::dmat4x3 camera(double turn_deg, double nearness = 0.1) {
    const Vec3 near = test::direction(60, turn_deg), across = test::direction(90, turn_deg + 90),
               along = glm::cross(near, across);
    const double w = nearness, middle = 300;
    const Vec3 u = k_zoom * across - middle * w * near, v = -k_zoom * along - middle * w * near;
    return {{u.x, v.x, -w * near.x},
            {u.y, v.y, -w * near.y},
            {u.z, v.z, -w * near.z},
            {middle, middle, 1}};
}

glm::dvec2 pixel(const glm::dmat4x3& projection, const Vec3& place) {
    const Vec3 p = projection * glm::dvec4(place, 1);
    return {p.x / p.z, p.y / p.z};
}

// A cube of which one side leans and stands out, and another one is turned.
Solid truth() {
    std::vector<NamedPlane> planes;
    for (const Facet& f : test::cube().facets) planes.push_back({f.name, f.plane});
    planes[1].plane = {test::direction(87, 1), 1.05};
    planes[4].plane.normal = test::direction(90, -88);
    return test::enclosed(planes);
}

WrittenReading length(const char* kind, double value, double sigma,
                      std::vector<std::string> of = {}) {
    WrittenReading written;
    written.id = kind;
    written.kind = kind;
    written.of = std::move(of);
    written.value = value;
    written.sigma = sigma;
    return written;
}

struct Photographs {
    int frames = 6, points = 3;
    double sigma = 0, nearness = 0.1;
    unsigned seed = 1;
    glm::dmat4 scene_from_mesh{1};  ///< how the mesh stands before the cameras
};

// Every edge in every frame. Without errors they count as known to 0.3 pixels.
std::vector<WrittenReading> lines_of(const Solid& solid, const Photographs& taken = {}) {
    std::mt19937_64 random(taken.seed);
    std::normal_distribution<double> normal;
    std::vector<WrittenReading> all;
    for (int k = 0; k < taken.frames; ++k) {
        const glm::dmat4x3 seen = camera(360.0 * k / taken.frames + 7, taken.nearness);
        for (const Edge& e : half_edges(solid).edges) {
            std::vector<glm::dvec2> points;
            for (int i = 0; i < taken.points; ++i) {
                const Vec3 &from = solid.vertices[std::size_t(e.from)],
                           &to = solid.vertices[std::size_t(e.to)];
                points.push_back(pixel(seen, from + (i + 0.5) / taken.points * (to - from)));
                points.back() += taken.sigma * glm::dvec2(normal(random), normal(random));
            }
            WrittenReading& written = all.emplace_back();
            written.kind = "line";
            written.of = {solid.facets[std::size_t(e.left)].name,
                          solid.facets[std::size_t(e.right)].name};
            written.id = fmt::format("{}:{}/{}", k, written.of[0], written.of[1]);
            written.sigma = taken.sigma > 0 ? taken.sigma : 0.3;
            written.seen_line = std::make_shared<const SeenLine>(
                line_through(points, seen * taken.scene_from_mesh));
        }
    }
    return all;
}

FitResult fitted(const Solid& mesh, std::vector<WrittenReading> written,
                 const std::vector<WrittenReading>& others, const std::string& up = "T") {
    written.insert(written.end(), others.begin(), others.end());
    FitOptions options;
    options.findings = false;
    return fit_stone(fit_input(test::stone_of(mesh, up), written), options);
}

void expect_similar(const Solid& found, const Solid& to, double size, double within) {
    for (const Facet& a : to.facets) {
        const Vec3& n = found.facets[std::size_t(find_facet(found, a.name))].plane.normal;
        for (const Facet& b : to.facets) {
            const Vec3& m = found.facets[std::size_t(find_facet(found, b.name))].plane.normal;
            EXPECT_NEAR(glm::dot(n, m), glm::dot(a.plane.normal, b.plane.normal), within)
                << a.name << " " << b.name;
        }
    }
    EXPECT_NEAR(volume(found), std::pow(size, 3) * volume(to), 10 * within);
}

TEST(SeenLine, MomentsGiveTheSquaresOfDistancesFromAnyLine) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    std::vector<glm::dvec2> points;
    for (int i = 0; i < 7; ++i) {
        const double along = 20 * normal(random);
        points.emplace_back(50 + 0.8 * along + normal(random), 90 - 0.6 * along + normal(random));
    }
    const SeenLine line = line_through(points, glm::dmat4x3(1));
    for (int k = 0; k < 20; ++k) {
        const double angle = normal(random), off = 40 * normal(random);
        const glm::dvec2 across{std::cos(angle), std::sin(angle)};
        double squares = 0;
        for (const glm::dvec2& p : points) squares += std::pow(glm::dot(across, p) - off, 2);
        const double middle = glm::dot(across, line.middle) - off,
                     slope = line.reach * glm::dot(across, line.along);
        EXPECT_NEAR(7 * (middle * middle + slope * slope) + line.scatter, squares, 1e-8 * squares);
    }
}

// The lines are exact, and give the shape to rounding; the depth, which was read, gives the size.
TEST(SeenLines, AndALengthGiveShapeAndSize) {
    for (const double nearness : {0.1, 0.0}) {
        const FitResult fit = fitted(test::cube(), lines_of(truth(), {.nearness = nearness}),
                                     {length("depth", 2.2, 0.01)});
        EXPECT_EQ(fit.status, FitStatus::converged) << fit.message;
        EXPECT_EQ(fit.statistics.rank_defect, 0);
        expect_similar(fit.solid, truth(), 1.1, 1e-7);
        for (const FittedReading& r : fit.readings) {
            if (r.kind != ReadingKind::line) continue;
            EXPECT_NEAR(r.sigma, 0.3 / std::sqrt(3.0), 1e-12);
            ASSERT_TRUE(r.line);
            EXPECT_EQ(r.line->points, 3);
            EXPECT_LT(r.line->worst, 1e-5);
        }
    }
}

TEST(SeenLines, TheMeshNeedNotStandAsItWasSeen) {
    const Vec3 x = test::direction(83, 6), z = glm::normalize(glm::cross(x, Vec3{0.1, 1, 0.05})),
               y = glm::cross(z, x);
    Photographs taken;
    taken.scene_from_mesh = {{1.1 * x, 0}, {1.1 * y, 0}, {1.1 * z, 0}, {0.1, -0.05, 0.2, 1}};
    const FitResult fit =
        fitted(test::cube(), lines_of(truth(), taken), {length("depth", 2, 0.01)});
    EXPECT_EQ(fit.status, FitStatus::converged) << fit.message;
    expect_similar(fit.solid, truth(), 1, 1e-7);
}

// The cameras know where a direction is, but not where a facet faces.
TEST(SeenLines, UpAsADirectionIsTheCameras) {
    std::vector<NamedPlane> planes;
    for (const Facet& f : truth().facets) planes.push_back({f.name, f.plane});
    planes[0].plane.normal = test::direction(1, 30);
    const Solid solid = test::enclosed(planes);
    const FitResult fit = fitted(test::cube(), lines_of(solid),
                                 {length("depth", width_along(solid, {0, 0, 1}), 0.01)}, "");
    EXPECT_EQ(fit.status, FitStatus::converged) << fit.message;
    EXPECT_EQ(fit.statistics.rank_defect, 0);
    expect_similar(fit.solid, solid, 1, 1e-7);
    for (std::size_t f = 0; f < planes.size(); ++f) {
        EXPECT_NEAR(fit.facets[f].plane.normal.z, planes[f].plane.normal.z, 1e-7);
        EXPECT_GT(fit.facets[f].sigma_inclination, 0);
    }
}

// One line tells less than how the mesh stands: that is nobody's question.
TEST(SeenLines, FewLinesLeaveNothingOpenThatOthersTell) {
    std::vector<WrittenReading> lines = lines_of(test::cube());
    lines.resize(1);
    const Stone stone = test::stone_of(test::cube());
    FitInput input = fit_input(stone, lines);
    for (const Reading& r : test::readings_of(stone.solid, 0.1, 0.01)) input.readings.push_back(r);
    const FitResult fit = fit_stone(input);
    EXPECT_EQ(fit.statistics.rank_defect, 0);
    EXPECT_EQ(fit.status, FitStatus::converged) << fit.message;
    EXPECT_NEAR(fit.readings[0].redundancy, 0, 1e-6);
}

TEST(SeenLines, SigmasHold) {
    constexpr int k_draws = 40;
    const Solid solid = truth();
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    double squares = 0, sizes = 0, chi2 = 0, dof = 0;
    int count = 0;
    for (unsigned draw = 0; draw < k_draws; ++draw) {
        const auto lines = lines_of(solid, {.frames = 4, .sigma = 0.5, .seed = draw});
        const double sigma = 0.01;
        const FitResult fit =
            fitted(test::cube(), lines, {length("depth", 2 + sigma * normal(random), sigma)});
        EXPECT_NE(fit.status, FitStatus::not_converged) << fit.message;
        chi2 += fit.statistics.chi2;
        dof += fit.statistics.dof;
        for (const FittedFacet& f : fit.facets) {
            const Facet& t = solid.facets[std::size_t(find_facet(solid, f.name))];
            const double tilt = inclination(t.plane.normal, Vec3{0, 0, 1});
            if (tilt < 0.1) continue;  // level: the angle folds
            squares += std::pow((f.inclination - tilt) / f.sigma_inclination, 2);
            ++count;
        }
        // The depth alone tells the size.
        sizes += std::pow((std::cbrt(volume(fit.solid) / volume(solid)) - 1) / (sigma / 2), 2);
    }
    // Five standard errors of the sums, as of independent numbers.
    EXPECT_NEAR(squares / count, 1, 5 * std::sqrt(2.0 / count));
    EXPECT_NEAR(chi2 / dof, 1, 5 * std::sqrt(2 / dof));
    EXPECT_NEAR(sizes / k_draws, 1, 5 * std::sqrt(2.0 / k_draws));
}

TEST(SeenLines, AWrongLineIsFound) {
    auto lines = lines_of(truth(), {.sigma = 0.3});
    std::vector<glm::dvec2> points = lines[7].seen_line->points;
    for (glm::dvec2& p : points) p += glm::dvec2{3, 3};
    lines[7].seen_line =
        std::make_shared<const SeenLine>(line_through(points, lines[7].seen_line->projection));
    const FitResult fit = fitted(test::cube(), lines, {length("depth", 2, 0.01)});
    EXPECT_EQ(fit.status, FitStatus::contradictory);
    ASSERT_FALSE(fit.findings.suspects.empty());
    EXPECT_EQ(fit.findings.suspects[0], lines[7].id);
    EXPECT_GT(fit.readings[7].line->worst, 1);
}

TEST(SeenLines, PointsOffAStraightLineAreTold) {
    const auto notes_with = [](double sigma) {
        auto lines = lines_of(truth(), {.points = 9, .sigma = 0.3});
        lines[4].sigma = sigma;
        const FitResult fit = fitted(test::cube(), lines, {length("depth", 2, 0.01)});
        std::string all;
        for (const std::string& note : fit.log.notes) all += note + "\n";
        return all;
    };
    EXPECT_EQ(notes_with(0.3), "");
    EXPECT_THAT(notes_with(0.05), HasSubstr("of 1 line lie farther"));
}

// Slopes against central differences, and the motions of the stone that nothing sees.
TEST(SeenLines, FormulasAtAnOddShape) {
    const Stone stone = test::stone_of(test::cube());
    const FitInput input = fit_input(stone, lines_of(truth(), {.frames = 2}));
    const FitModel model(input.stone, input.readings, {});
    const auto moved = [](const Shape& shape, const std::vector<double>& step) {
        return RowWriter(shape).parameters().retracted(shape, step);
    };
    Shape shape = model.mesh_shape();
    const auto size = std::size_t(layout_of(shape).size());
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal(0, 0.1);
    std::vector<double> odd(size);
    for (double& s : odd) s = normal(random);
    shape = moved(shape, odd);
    Equation base;
    const double h = 1e-5;
    for (const std::size_t r : {0, 5, 17}) {
        for (const Equation& e : line_equations(*model.lines().of(r), base)) {
            const Eigen::VectorXd slopes(RowWriter(shape).function(e.formula(shape)));
            for (std::size_t i = 0; i < size; ++i) {
                std::vector<double> step(size, 0.0);
                step[i] = h;
                const double up = e.formula(moved(shape, step)).value;
                step[i] = -h;
                const double down = e.formula(moved(shape, step)).value;
                EXPECT_NEAR(slopes(Eigen::Index(i)), (up - down) / (2 * h), 1e-7) << i;
            }
        }
    }
    Shape level = shape;
    level.normals[std::size_t(model.frame().up_facet())] = {0, 0, 1};
    EXPECT_EQ(linearise(model, level, model.mesh_outline()).gauge_rows.size(), 4u);
}

}  // namespace
}  // namespace culet
