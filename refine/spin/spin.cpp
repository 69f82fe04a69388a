#include "refine/spin/spin.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "compare/turntable/tangency.h"
#include "refine/spin/ground_texture.h"
#include "refine/spin/series_faults.h"
#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Of a turn about an even one: hand-made and cheap turntables.
constexpr double k_turn_sigma = radians(0.5);
// As halves of a real series differ: axis in pixels, roll and elevation in radians, perspective
// times the stone's reach in pixels; a turn.
constexpr std::array<double, 4> k_ground_sigmas{0.1, radians(0.05), radians(0.05), 0.002};
constexpr double k_ground_turn_sigma = radians(0.03);
// Pixels from the expected outline: first as the coarse outlines tell it, then as the edges do.
constexpr double k_first_reach = 4, k_reach = 2.5;
constexpr int k_refits = 2;
// Pixels: coarse outlines of a turning stone disagree by one or two, of another thing by tens.
constexpr double k_doubtful_tangents = 5, k_doubtful_scatter = 1, k_suspicious_scatter = 0.7;

class Spin {
public:
    Spin(const std::vector<SpinFrame>& frames, const SpinOptions& options, const Progress& progress)
        : frames_(frames),
          options_(options),
          progress_(progress),
          coarse_(frames.size()),
          edges_(frames.size()) {}

    SpinResult run() {
        result_.frames.resize(frames_.size());
        trace();
        find_turntable();
        done(0.2);
        fit_coarse_outlines();
        done(0.45);
        look_at_ground();
        done(0.6);
        refit(k_first_reach, has_ground_);
        done(0.7);
        for (int i = 0; i < k_refits; ++i) {
            refit(k_reach);
            done(0.7 + 0.15 * (i + 1) / k_refits);
        }
        compare_halves();
        done(0.95);
        hold_out();
        stand_upright();
        take_frames();
        judge();
        return std::move(result_);
    }

private:
    void done(double part) const {
        if (progress_ && !progress_(part)) throw Interrupted();
    }
    template <class Work>
    void in_arena(const Work& work) const {
        tbb::task_arena arena(options_.threads > 0 ? options_.threads : tbb::task_arena::automatic);
        arena.execute(work);
    }
    template <class Work>
    void each_frame(const Work& work) const {
        in_arena([&] { tbb::parallel_for(std::size_t{0}, frames_.size(), work); });
    }

    void trace() {
        each_frame([&](std::size_t f) { coarse_[f] = coarse_outline(frames_[f].picture); });
        for (std::size_t f = 0; f < frames_.size(); ++f) {
            result_.frames[f].trouble = coarse_[f].trouble;
            if (coarse_[f].trouble.empty() && !frames_[f].held_out) used_.push_back(f);
        }
        if (int(used_.size()) >= k_least_frames) return;
        for (std::size_t f = 0; f < frames_.size(); ++f) {
            if (!coarse_[f].trouble.empty()) throw InputError(frames_[f].name, coarse_[f].trouble);
        }
        throw InputError(fmt::format("{} frames at least are needed to find a stone, not {}",
                                     k_least_frames, used_.size()));
    }

    // Tries both senses of turning; the camera looks down.
    void find_turntable() {
        const double step = options_.step != 0 ? std::abs(options_.step)
                                               : 2 * std::numbers::pi / double(frames_.size());
        std::vector<OutlineHull> hulls;
        for (const std::size_t f : used_) hulls.push_back({coarse_[f].corners});
        TangencyOptions options;
        options.from_above = true;
        options.turn_sigma = k_turn_sigma;
        for (const double deg : {3, 20, 35, 50, 65, 80}) options.elevations.push_back(radians(deg));
        Tangency best;
        for (const double sense : {1.0, -1.0}) {
            std::vector<double> turns;
            for (const std::size_t f : used_) turns.push_back(sense * step * double(f));
            const Tangency found = tangency_of(hulls, turns, options);
            if (!best.turns.empty() && found.residual_px >= best.residual_px) continue;
            best = found;
            step_ = sense * step;
        }
        take_series(best, options);
        result_.tangent_px = best.residual_px;
        fit_.series = {{best.table[0], best.table[1], best.table[2], 0}, best.turns};
        expected_.turn_sigma = k_turn_sigma;
        expected_.turns = best.expected.turns;
    }

    void take_series(const Tangency& found, const TangencyOptions& options) {
        std::vector<std::string> names;
        std::vector<CoarseOutline> outlines;
        for (const std::size_t f : used_) {
            names.push_back(frames_[f].name);
            outlines.push_back(coarse_[f]);
        }
        faults_ = faults_of_series(found, options, step_, names, outlines);
        result_.notes = faults_.notes;
        step_ *= found.expected.scale;
    }

    void fit_coarse_outlines() {
        try {
            fit_ = fitted([&](std::size_t f) { return places_along(coarse_[f].corners); });
        } catch (const InputError&) {
            const SeriesFaults cut = cut_out(frames_, coarse_);
            if (cut.trouble.empty()) throw;
            throw InputError(cut.trouble + ". " + cut.remedy);
        }
    }

    // Grain on the ground tells camera and turns far better than the stone, if there is any.
    void look_at_ground() {
        std::vector<const LevelPicture*> pictures;
        std::vector<std::vector<glm::dvec2>> stones;
        double deepest = 0;
        for (const std::size_t f : used_) {
            pictures.push_back(&frames_[f].picture);
            stones.push_back(coarse_[f].corners);
            for (const glm::dvec2& c : coarse_[f].corners)
                deepest = std::max(deepest, glm::length(c));
        }
        ground_ = ground_texture(pictures, stones, fit_.series, deepest);
        result_.ground_agreement = ground_.agreement;
        if (!ground_.found()) return;
        expected_ = {ground_.series.camera, k_ground_sigmas, ground_.series.turns,
                     k_ground_turn_sigma};
        expected_.sigmas[3] /= deepest;
        fit_.series = ground_.series;
        has_ground_ = true;
    }

    // `every`: of the frames used, from `first`.
    template <class Points>
    TurningFit fitted(const Points& points, std::size_t first = 0, std::size_t every = 1) const {
        TurningOutlines given;
        given.start.camera = fit_.series.camera;
        for (std::size_t k = first; k < used_.size(); k += every) {
            given.outlines.push_back(points(used_[k]));
            given.expected.turns.push_back(expected_.turns[k]);
            given.start.turns.push_back(fit_.series.turns[k]);
        }
        given.expected.camera = expected_.camera;
        given.expected.sigmas = expected_.sigmas;
        given.expected.turn_sigma = expected_.turn_sigma;
        for (const Facet& facet : fit_.solid.facets) given.planes.push_back(facet.plane);
        return fit_turning(given);
    }

    PicturePoints edges_of(std::size_t f, double turn, double reach) const {
        return edge_points(frames_[f].picture,
                           outline_in_picture(fit_.solid.vertices, fit_.series.camera, turn),
                           reach);
    }

    void refit(double reach, bool anew = false) {
        in_arena([&] {
            tbb::parallel_for(std::size_t{0}, used_.size(), [&](std::size_t k) {
                edges_[used_[k]] = edges_of(used_[k], fit_.series.turns[k], reach);
            });
        });
        // Planes of the coarse outlines have followed the errors of camera and turns.
        if (anew) fit_.solid = {};
        fit_ = fitted([&](std::size_t f) { return edges_[f]; });
    }

    // Edges are off along whole sides, not point by point: how far halves of the frames differ says
    // more than the scatter.
    void compare_halves() {
        in_arena([&] {
            tbb::parallel_for(std::size_t{0}, halves_.size(), [&](std::size_t h) {
                halves_[h] = fitted([&](std::size_t f) { return edges_[f]; }, h, halves_.size());
            });
        });
        result_.halves.factor = factor_of_halves(halves_[0], halves_[1]);
        result_.halves.elevation =
            halves_[0].series.camera.elevation - halves_[1].series.camera.elevation;
        for (double& sigma : fit_.tilt_sigmas)
            sigma = std::min(k_turning_tilt, sigma * result_.halves.factor);
        for (std::size_t k = 0; k < used_.size(); ++k) {
            SpinFrameResult& frame = result_.frames[used_[k]];
            frame.used = true;
            frame.turn = fit_.series.turns[k];
            frame.turn_sigma = fit_.turn_sigmas[k] * result_.halves.factor;
        }
    }

    // As far from its even turn as its neighbours are from theirs.
    double expected_turn(std::size_t f) const {
        double sum = 0, weights = 0;
        for (const std::size_t other : used_) {
            const double weight = std::exp(-std::abs(double(other) - double(f)));
            sum += weight * (*result_.frames[other].turn - step_ * double(other));
            weights += weight;
        }
        return step_ * double(f) + (weights > 0 ? sum / weights : 0);
    }

    void hold_out() {
        each_frame([&](std::size_t f) {
            SpinFrameResult& frame = result_.frames[f];
            if (!frames_[f].held_out || !coarse_[f].trouble.empty()) return;
            if (has_ground_) {
                frame.turn = turn_by_ground(ground_, frames_[f].picture, coarse_[f].corners,
                                            expected_turn(f));
                frame.turn_sigma = k_ground_turn_sigma;
                edges_[f] = edges_of(f, *frame.turn, k_reach);
                return;
            }
            FittedTurn turn = fitted_turn(fit_.solid.vertices, fit_.series.camera, expected_turn(f),
                                          places_along(coarse_[f].corners), fit_.scatter);
            for (const double reach : {k_first_reach, k_reach}) {
                edges_[f] = edges_of(f, turn.turn, reach);
                if (edges_[f].empty()) break;
                turn = fitted_turn(fit_.solid.vertices, fit_.series.camera, turn.turn, edges_[f],
                                   fit_.scatter);
            }
            frame.turn = turn.turn;
            frame.turn_sigma = turn.sigma * result_.halves.factor;
        });
    }

    void take_frames() {
        result_.camera = fit_.series.camera;
        result_.scatter_px = fit_.scatter;
        for (std::size_t f = 0; f < frames_.size(); ++f) {
            SpinFrameResult& frame = result_.frames[f];
            if (!frame.turn) continue;
            std::vector<double> sizes;
            double squares = 0;
            for (const double d :
                 outline_distances(corners_, fit_.series.camera, *frame.turn, edges_[f])) {
                squares += d * d;
                sizes.push_back(std::abs(d));
            }
            if (sizes.empty()) continue;
            frame.rms_px = std::sqrt(squares / double(sizes.size()));
            frame.median_px = upper_median(std::move(sizes));
        }
    }

    StandingStone standing(const TurningFit& fit, std::size_t first, std::size_t every) const {
        std::vector<const LevelPicture*> pictures;
        for (std::size_t k = first; k < used_.size(); k += every)
            pictures.push_back(&frames_[used_[k]].picture);
        return standing_stone(fit, pictures);
    }

    void stand_upright() {
        if (has_ground_) {
            lay_on_ground(fit_, ground_.depth);
            for (TurningFit& half : halves_) lay_on_ground(half, ground_.depth);
        }
        StandingStone stone;
        in_arena([&] { stone = standing(fit_, 0, 1); });
        std::array<StandingStone, 2> halves;
        in_arena([&] {
            for (std::size_t h = 0; h < 2; ++h) halves[h] = standing(halves_[h], h, 2);
        });
        compare_stones(halves[0], halves[1], result_.halves);
        result_.proportions =
            proportions_of(stone, stone.crowned ? stone.crowned->edge_sigma : fit_.scatter);
        for (SpinProportion& p : result_.proportions) {
            for (const auto& [name, difference] : result_.halves.proportions)
                if (name == p.name) p.sigma = std::max(p.sigma, std::abs(difference) / 2);
        }
        result_.solid = stone.solid;
        result_.tilt_sigmas = stone.tilt_sigmas;
        result_.crowned = stone.crowned;
        result_.completed = stone.completed;
        for (const Vec3& v : stone.solid.vertices) corners_.push_back(stone.on_turntable(v));
        for (std::size_t f = 0; f < stone.seen.size(); ++f) {
            if (!stone.seen[f]) result_.unseen.push_back(int(f));
        }
        for (std::size_t f = 0; f < frames_.size(); ++f) {
            SpinFrameResult& frame = result_.frames[f];
            if (frame.turn)
                frame.projection = projection_of(picture_axes(fit_.series.camera, *frame.turn),
                                                 stone.at, frames_[f].picture);
        }
    }

    void judge() {
        if (faults_.trouble.empty() && result_.scatter_px > k_suspicious_scatter)
            faults_ = cut_out(frames_, coarse_);
        result_.trouble = faults_.trouble;
        result_.remedy = faults_.remedy;
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
    std::vector<CoarseOutline> coarse_;
    std::vector<PicturePoints> edges_;
    std::vector<std::size_t> used_;
    double step_ = 0;  // with the sense of turning
    ExpectedSeries expected_;
    SeriesFaults faults_;
    GroundTexture ground_;
    bool has_ground_ = false;
    TurningFit fit_;
    std::array<TurningFit, 2> halves_;
    std::vector<Vec3> corners_;  // of the stone that is written, in the turntable's frame
    SpinResult result_;
};

}  // namespace

SpinResult spin(const std::vector<SpinFrame>& frames, const SpinOptions& options,
                const Progress& progress) {
    return Spin(frames, options, progress).run();
}

}  // namespace culet
