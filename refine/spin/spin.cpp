#include "refine/spin/spin.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "refine/spin/series_outlines.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

// Pixels: coarse outlines of a turning stone disagree by one or two, of another thing by tens.
constexpr double k_doubtful_tangents = 5, k_doubtful_scatter = 1, k_suspicious_scatter = 0.7;

void take_distances(const std::vector<FromOutline>& distances, double long_side,
                    SpinFrameResult& frame) {
    std::vector<double> sizes, on_lines;
    double squares = 0;
    for (const auto& [distance, side] : distances) {
        squares += distance * distance;
        sizes.push_back(std::abs(distance));
        if (side >= long_side) on_lines.push_back(sizes.back());
    }
    if (sizes.empty()) return;
    frame.rms_px = std::sqrt(squares / double(sizes.size()));
    frame.median_px = upper_median(std::move(sizes));
    if (!on_lines.empty()) frame.line_median_px = upper_median(std::move(on_lines));
}

class Spin {
public:
    Spin(const std::vector<SpinFrame>& frames, const SpinOptions& options, const Progress& progress)
        : frames_(frames), options_(options), progress_(progress) {}

    SpinResult run() {
        result_.frames.resize(frames_.size());
        if (options_.symmetry) result_.tried = *options_.symmetry;
        outlines_ = series_outlines(frames_, options_.step, progress_);
        compare_halves();
        stand_upright();
        if (progress_ && !progress_(0.95)) throw Interrupted();
        take_stone();
        hold_out();
        take_frames();
        judge();
        return std::move(result_);
    }

private:
    // Edges are off along whole sides, not point by point: how far halves of the frames differ says
    // more than the scatter.
    void compare_halves() {
        const auto& halves = outlines_.halves;
        result_.halves.factor = factor_of_halves(halves[0], halves[1]);
        result_.halves.elevation =
            halves[0].series.camera.elevation - halves[1].series.camera.elevation;
        for (double& sigma : outlines_.fit.tilt_sigmas)
            sigma = std::min(k_turning_tilt, sigma * result_.halves.factor);
    }

    SeriesEvidence evidence(std::size_t first, std::size_t every) const {
        SeriesEvidence all;
        all.expected = outlines_.expected;
        all.expected.turns.clear();
        for (std::size_t k = first; k < outlines_.used.size(); k += every) {
            const std::size_t f = outlines_.used[k];
            all.pictures.push_back(&frames_[f].picture);
            all.outlines.push_back(outlines_.edges[f]);
            all.expected.turns.push_back(outlines_.expected.turns[k]);
        }
        all.sigmas_times = result_.halves.factor;
        if (outlines_.has_ground) all.ground_depth = outlines_.ground.depth;
        all.symmetry = result_.tried;
        return all;
    }

    void stand_upright() {
        std::array<JointStone, 3> stones;  // of all frames, and of every other one
        tbb::parallel_for(std::size_t{0}, stones.size(), [&](std::size_t s) {
            stones[s] = s == 0 ? joint_stone(outlines_.fit, evidence(0, 1))
                               : joint_stone(outlines_.halves[s - 1], evidence(s - 1, 2));
        });
        compare_stones(stones[1].stone, stones[2].stone, result_.halves);
        outlines_.fit = std::move(stones[0].fit);
        stone_ = std::move(stones[0].stone);
        result_.symmetry = stones[0].symmetry;
        for (std::size_t k = 0; k < outlines_.used.size(); ++k) {
            SpinFrameResult& frame = result_.frames[outlines_.used[k]];
            frame.used = true;
            frame.turn = outlines_.fit.series.turns[k];
            frame.turn_sigma = outlines_.fit.turn_sigmas[k];
        }
    }

    void take_stone() {
        result_.proportions =
            proportions_of(stone_, stone_.edges > 0 ? stone_.edge_sigma : outlines_.fit.scatter);
        for (SpinProportion& p : result_.proportions) {
            for (const auto& [name, difference] : result_.halves.proportions)
                if (name == p.name) p.sigma = std::max(p.sigma, std::abs(difference) / 2);
        }
        result_.solid = stone_.solid;
        result_.tilt_sigmas = stone_.tilt_sigmas;
        result_.edges = stone_.edges;
        result_.edge_sigma_px = stone_.edge_sigma;
        for (std::size_t f = 0; f < stone_.seen.size(); ++f) {
            if (!stone_.seen[f]) result_.unseen.push_back(int(f));
            if (stone_.is_copy[f]) result_.copies.push_back(int(f));
        }
    }

    // As far from its even turn as its neighbours are from theirs.
    double expected_turn(std::size_t f) const {
        double sum = 0, weights = 0;
        for (const std::size_t other : outlines_.used) {
            const double weight = std::exp(-std::abs(double(other) - double(f)));
            sum += weight * (*result_.frames[other].turn - outlines_.step * double(other));
            weights += weight;
        }
        return outlines_.step * double(f) + (weights > 0 ? sum / weights : 0);
    }

    void hold_out() {
        tbb::parallel_for(std::size_t{0}, frames_.size(), [&](std::size_t f) {
            if (frames_[f].held_out && outlines_.coarse[f].trouble.empty()) find_turn(f);
        });
    }

    void find_turn(std::size_t f) {
        SpinFrameResult& frame = result_.frames[f];
        const LevelPicture& picture = frames_[f].picture;
        const std::vector<glm::dvec2>& corners = outlines_.coarse[f].corners;
        PicturePoints& edges = outlines_.edges[f];
        if (outlines_.has_ground) {
            frame.turn = turn_by_ground(outlines_.ground, picture, corners, expected_turn(f));
            frame.turn_sigma = k_ground_turn_sigma;
            edges = outlines_.edges_at(picture, *frame.turn, k_reach);
            return;
        }
        const TurningFit& fit = outlines_.fit;
        FittedTurn turn = fitted_turn(fit.solid.vertices, fit.series.camera, expected_turn(f),
                                      places_along(corners), fit.scatter);
        for (const double reach : {k_first_reach, k_reach}) {
            edges = outlines_.edges_at(picture, turn.turn, reach);
            if (edges.empty()) break;
            turn =
                fitted_turn(fit.solid.vertices, fit.series.camera, turn.turn, edges, fit.scatter);
        }
        frame.turn = turn.turn;
        frame.turn_sigma = turn.sigma * result_.halves.factor;
    }

    void take_frames() {
        const TurningFit& fit = outlines_.fit;
        result_.camera = fit.series.camera;
        result_.scatter_px = fit.scatter;
        for (std::size_t f = 0; f < frames_.size(); ++f) {
            SpinFrameResult& frame = result_.frames[f];
            frame.trouble = outlines_.coarse[f].trouble;
            if (!frame.turn) continue;
            frame.projection = projection_of(picture_axes(fit.series.camera, *frame.turn),
                                             stone_.at, frames_[f].picture);
            take_distances(outline_distances(fit.solid.vertices, fit.series.camera, *frame.turn,
                                             outlines_.edges[f]),
                           k_long_side * result_.width().value, frame);
        }
    }

    void judge() {
        result_.tangent_px = outlines_.tangent_px;
        result_.ground_agreement = outlines_.ground.agreement;
        result_.notes = outlines_.faults.notes;
        if (options_.symmetry && !result_.symmetry)
            result_.notes.emplace_back(
                "the photographs contradict the symmetry of the cut that was given: it is not "
                "used");
        SeriesFaults faults = outlines_.faults;
        if (faults.trouble.empty() && result_.scatter_px > k_suspicious_scatter)
            faults = cut_out(frames_, outlines_.coarse);
        result_.trouble = faults.trouble;
        result_.remedy = faults.remedy;
        if (!result_.trouble.empty()) return;
        if (result_.tangent_px > k_doubtful_tangents)
            result_.trouble = fmt::format("the outlines contradict each other by {:.1f} pixels",
                                          result_.tangent_px);
        else if (result_.scatter_px > k_doubtful_scatter)
            result_.trouble = fmt::format(
                "the edges in the pictures lie {:.1f} pixels off the outlines of any one stone",
                result_.scatter_px);
        else
            return;
        result_.remedy =
            "Give all frames of one turn in their order, or --step; the camera must stand still, "
            "the stone must not slip on the turntable, and nothing with sharp edges may touch it";
    }

    const std::vector<SpinFrame>& frames_;
    const SpinOptions& options_;
    const Progress& progress_;
    SeriesOutlines outlines_;
    StandingStone stone_;
    SpinResult result_;
};

}  // namespace

SpinResult spin(const std::vector<SpinFrame>& frames, const SpinOptions& options,
                const Progress& progress) {
    SpinResult result;
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    arena.execute([&] { result = Spin(frames, options, progress).run(); });
    return result;
}

}  // namespace culet
