#include "compare/turntable/turntable.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/matrix.hpp>
#include <numbers>
#include <numeric>

#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Lines of sight nearer to parallel or opposite share no well-determined plane.
constexpr double k_least_sine = 0.1;
// Tolerance for outlines half a turn apart, as a share of a step.
constexpr double k_opposite = 0.05;
constexpr std::size_t k_most_pairs = 4000;
constexpr double k_loss_px = 1;
// A sharp picture's blur and noise leave a residual of 0.1 to 0.2 pixels (turntable_test.cpp).
constexpr double k_doubtful_px = 1;
// With a larger uncertainty of the camera's angles, outlines say nothing useful about a facet.
constexpr double k_unknown = radians(1);
// Determinant of the normal equations over the product of the diagonal: below this it is rounding
// error.
constexpr double k_singular = 1e-12;

using Hull = std::vector<glm::dvec2>;

template <class T>
using V3 = Eigen::Matrix<T, 3, 1>;

// The camera's axes for an outline: towards it, right and up in the picture.
template <class T>
struct View {
    V3<T> sight, right, up;
};
template <class T>
View<T> view_at(double turn, const T& elevation) {
    const T c = cos(elevation), s = sin(elevation);
    const double x = std::cos(turn), y = std::sin(turn);
    return {{c * x, c * y, s}, {T(-y), T(x), T(0)}, {-s * x, -s * y, c}};
}

// How far the outline reaches in a direction perpendicular to the line of sight.
template <class T>
T reach(const Hull& hull, const View<T>& view, const V3<T>& direction, const T* table) {
    const T x = view.right.dot(direction), y = view.up.dot(direction);
    const T c = cos(table[1]), s = sin(table[1]);
    // The direction in the picture, whose up is the axis, rotated by the roll.
    const T u = c * x + s * y, v = c * y - s * x;
    const auto number = [](const T& t) {
        if constexpr (std::is_same_v<T, double>)
            return t;
        else
            return t.a;
    };
    const double nu = number(u), nv = number(v);
    std::size_t far = 0;
    double most = -1e300;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const double d = nu * hull[i].x + nv * hull[i].y;
        if (d > most) {
            most = d;
            far = i;
        }
    }
    return u * (T(hull[far].x) - table[0]) + v * hull[far].y;
}

// Both outlines touch the plane through their lines of sight; `side`: +1 above, -1 below.
struct SharedPlane {
    const Hull *one, *other;
    double turn_one, turn_other, side;

    template <class T>
    bool operator()(const T* const table, T* residual) const {
        const View<T> a = view_at(turn_one, table[2]), b = view_at(turn_other, table[2]);
        V3<T> normal = a.sight.cross(b.sight);
        normal /= normal.norm();
        if (normal.z() < T(0)) normal = -normal;
        normal *= T(side);
        residual[0] = reach(*one, a, normal, table) - reach(*other, b, normal, table);
        return true;
    }
};

// Half a turn apart: both touch the plane beside the axis.
struct OppositeReach {
    const Hull *one, *other;
    double turn, side;

    template <class T>
    bool operator()(const T* const table, T* residual) const {
        const View<T> a = view_at(turn, table[2]), b = view_at(turn + std::numbers::pi, table[2]);
        const V3<T> normal = T(side) * a.right;
        residual[0] = reach(*one, a, normal, table) - reach(*other, b, normal, table);
        return true;
    }
};

template <class Residual>
ceres::CostFunction* cost(const Residual& residual) {
    return new ceres::AutoDiffCostFunction<Residual, 1, 3>(new Residual(residual));
}

struct Problem {
    std::vector<Hull> hulls;
    std::vector<double> turns;
    ceres::Problem ceres;
    std::array<double, 3> table{0, 0, 0};
    int opposite = 0, shared = 0;

    void add(ceres::CostFunction* function) {
        ceres.AddResidualBlock(function, new ceres::HuberLoss(k_loss_px), table.data());
    }
};

void add_opposite(Problem& problem, double step) {
    for (std::size_t i = 0; i < problem.hulls.size(); ++i) {
        for (std::size_t j = i + 1; j < problem.hulls.size(); ++j) {
            const double apart = problem.turns[j] - problem.turns[i] - std::numbers::pi;
            if (std::abs(std::remainder(apart, 2 * std::numbers::pi)) > k_opposite * std::abs(step))
                continue;
            for (const double side : {1.0, -1.0})
                problem.add(cost(
                    OppositeReach{&problem.hulls[i], &problem.hulls[j], problem.turns[i], side}));
            ++problem.opposite;
        }
    }
}

void add_shared(Problem& problem, const std::vector<BackLitOutline>& outlines) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < problem.hulls.size(); ++i) {
        for (std::size_t j = i + 1; j < problem.hulls.size(); ++j) {
            if (std::abs(std::sin(problem.turns[j] - problem.turns[i])) > k_least_sine)
                pairs.emplace_back(i, j);
        }
    }
    const std::size_t every = pairs.size() / k_most_pairs + 1;
    for (std::size_t k = 0; k < pairs.size(); k += every) {
        const auto [i, j] = pairs[k];
        for (const double side : {1.0, -1.0}) {
            const auto is_hidden = [&](const BackLitOutline& o) {
                return side > 0 ? o.at_top : o.at_bottom;
            };
            if (is_hidden(outlines[i]) || is_hidden(outlines[j])) continue;
            problem.add(cost(SharedPlane{&problem.hulls[i], &problem.hulls[j], problem.turns[i],
                                         problem.turns[j], side}));
            ++problem.shared;
        }
    }
}

// Several starts: a table's flat top makes a kink at elevation 0, where the search would stop.
constexpr std::array<double, 9> k_starts_deg{0, -0.5, 0.5, -1, 1, -2.5, 2.5, -6, 6};

// Returns the number of residuals.
int solve(Problem& problem) {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 50;
    options.function_tolerance = 1e-10;
    options.logging_type = ceres::SILENT;
    const std::array<double, 3> start = problem.table;
    std::array<double, 3> best = start;
    double least = 1e300;
    for (const double elevation_deg : k_starts_deg) {
        problem.table = start;
        problem.table[2] = radians(elevation_deg);
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem.ceres, &summary);
        if (!(summary.final_cost < least)) continue;
        least = summary.final_cost;
        best = problem.table;
    }
    problem.table = best;
    return problem.ceres.NumResiduals();
}

void take_sigmas(Problem& problem, Turntable& table) {
    ceres::CRSMatrix slopes;
    problem.ceres.Evaluate({}, nullptr, nullptr, nullptr, &slopes);
    glm::dmat3 normal(0);
    for (std::size_t row = 0; row + 1 < slopes.rows.size(); ++row) {
        for (int a = slopes.rows[row]; a < slopes.rows[row + 1]; ++a) {
            for (int b = slopes.rows[row]; b < slopes.rows[row + 1]; ++b)
                normal[slopes.cols[std::size_t(a)]][slopes.cols[std::size_t(b)]] +=
                    slopes.values[std::size_t(a)] * slopes.values[std::size_t(b)];
        }
    }
    const double squares = normal[0][0] * normal[1][1] * normal[2][2];
    const bool is_regular = glm::determinant(normal) > k_singular * squares;
    const glm::dmat3 inverse = is_regular ? glm::inverse(normal) : glm::dmat3(HUGE_VAL);
    table.sigma_axis_px = table.residual_px * std::sqrt(inverse[0][0]);
    table.sigma_roll = table.residual_px * std::sqrt(inverse[1][1]);
    table.sigma_elevation = table.residual_px * std::sqrt(inverse[2][2]);
}

void judge(const std::vector<BackLitOutline>& outlines, double step, Turntable& table) {
    const bool is_known = table.sigma_roll < k_unknown && table.sigma_elevation < k_unknown;
    if (table.residual_px <= k_doubtful_px && is_known) return;
    table.trouble = table.residual_px > k_doubtful_px
                        ? fmt::format(
                              "the outlines contradict each other by {:.1f} pixels, where a "
                              "steady stone in sharp pictures leaves less than {:g}",
                              table.residual_px, k_doubtful_px)
                        : "the outlines do not tell how the camera stood to the axis";
    std::vector<double> contrasts;
    for (const BackLitOutline& outline : outlines) contrasts.push_back(outline.contrast);
    table.remedy = fmt::format(
        "Light the stone from behind, so that it is dark before a bright, even ground (along these "
        "outlines it is {:.0f} % darker; back-lit stones come to 90 %); check that each picture "
        "shows the stone {:g} degrees further, in this order, that the axis is upright or "
        "--turntable says otherwise, and that the camera is far away and about level",
        100 * upper_median(std::move(contrasts)), degrees(step));
}

}  // namespace

std::vector<std::size_t> order_of_numbers(const std::vector<std::string>& names) {
    std::vector<std::size_t> order(names.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return ::strverscmp(names[a].c_str(), names[b].c_str()) < 0;
    });
    return order;
}

Turntable turntable_of(const std::vector<BackLitOutline>& outlines, double step) {
    if (outlines.size() < 3) throw InputError("a turntable needs three pictures at least");
    Problem problem;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        if (outlines[i].corners.empty())
            throw InputError(fmt::format("picture {}: {}", i + 1, outlines[i].trouble));
        problem.hulls.push_back(outlines[i].corners);
        // When the stone turns one way, the camera goes round it the other way.
        problem.turns.push_back(-step * static_cast<double>(i));
    }
    // Start with the middle of all outlines.
    double sum = 0;
    for (const Hull& hull : problem.hulls) {
        const auto [low, high] =
            std::minmax_element(hull.begin(), hull.end(),
                                [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; });
        sum += (low->x + high->x) / 2;
    }
    problem.table[0] = sum / static_cast<double>(outlines.size());
    add_opposite(problem, step);
    add_shared(problem, outlines);
    if (problem.opposite == 0)
        throw InputError(
            fmt::format("no two of {} pictures are half a turn apart, {:g} degrees each: turn the "
                        "stone all the way round, in steps that divide 180 degrees",
                        outlines.size(), degrees(step)));
    const int residuals_used = solve(problem);
    Turntable table;
    table.axis_px = problem.table[0];
    table.roll = problem.table[1];
    table.elevation = problem.table[2];
    table.tangents = residuals_used;
    std::vector<double> residuals;
    ceres::Problem::EvaluateOptions evaluate;
    evaluate.apply_loss_function = false;
    problem.ceres.Evaluate(evaluate, nullptr, &residuals, nullptr, nullptr);
    for (const double r : residuals) table.residual_px += r * r;
    table.residual_px =
        std::sqrt(table.residual_px / std::max(1.0, static_cast<double>(residuals.size()) - 3));
    take_sigmas(problem, table);
    judge(outlines, step, table);
    return table;
}

std::vector<PlacedOutline> placed(const std::vector<BackLitOutline>& outlines, double step,
                                  const Turntable& table, double scale) {
    std::vector<PlacedOutline> result;
    const double c = std::cos(table.roll), s = std::sin(table.roll);
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const View<double> view = view_at(-step * static_cast<double>(i), table.elevation);
        PlacedOutline& one = result.emplace_back();
        one.direction = {view.sight.x(), view.sight.y(), view.sight.z()};
        for (const glm::dvec2& p : outlines[i].points) {
            const double u = p.x - table.axis_px, v = p.y;
            const V3<double> at =
                scale * ((c * u - s * v) * view.right + (s * u + c * v) * view.up);
            one.points.push_back({at.x(), at.y(), at.z()});
        }
    }
    return result;
}

OutlineWidths widths_of(const std::vector<BackLitOutline>& outlines, const Turntable& table) {
    OutlineWidths widths{1e300, 0};
    const double c = std::cos(table.roll), s = std::sin(table.roll);
    for (const BackLitOutline& outline : outlines) {
        double low = 1e300, high = -1e300;
        for (const glm::dvec2& p : outline.points) {
            low = std::min(low, c * p.x - s * p.y);
            high = std::max(high, c * p.x - s * p.y);
        }
        widths.least = std::min(widths.least, high - low);
        widths.largest = std::max(widths.largest, high - low);
    }
    return widths;
}

}  // namespace culet
