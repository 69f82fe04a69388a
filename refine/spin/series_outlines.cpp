#include "refine/spin/series_outlines.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "compare/turntable/tangency.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Of a turn about an even one: hand-made and cheap turntables.
constexpr double k_turn_sigma = radians(0.5);
// As halves of a real series differ: axis in pixels, roll and elevation in radians, perspective
// times the stone's reach in pixels.
constexpr std::array<double, 4> k_ground_sigmas{0.1, radians(0.05), radians(0.05), 0.002};
constexpr int k_refits = 2;

class OutlineStage {
public:
    OutlineStage(const std::vector<SpinFrame>& frames, double step, const Progress& progress)
        : frames_(frames), step_(step), progress_(progress) {
        found_.coarse.resize(frames.size());
        found_.edges.resize(frames.size());
    }

    SeriesOutlines run() {
        trace();
        find_turntable();
        done(0.2);
        fit_coarse_outlines();
        done(0.45);
        look_at_ground();
        done(0.6);
        refit(k_first_reach, found_.has_ground);
        done(0.7);
        for (int i = 0; i < k_refits; ++i) {
            refit(k_reach);
            done(0.7 + 0.1 * (i + 1) / k_refits);
        }
        tbb::parallel_for(std::size_t{0}, found_.halves.size(), [&](std::size_t h) {
            found_.halves[h] = fitted([&](std::size_t f) { return found_.edges[f]; }, h, 2);
        });
        done(0.85);
        return std::move(found_);
    }

private:
    void done(double part) const {
        if (progress_ && !progress_(part)) throw Interrupted();
    }

    void trace() {
        tbb::parallel_for(std::size_t{0}, frames_.size(), [&](std::size_t f) {
            found_.coarse[f] = coarse_outline(frames_[f].picture);
        });
        for (std::size_t f = 0; f < frames_.size(); ++f) {
            if (found_.coarse[f].trouble.empty() && !frames_[f].held_out) found_.used.push_back(f);
        }
        if (int(found_.used.size()) >= k_least_frames) return;
        for (std::size_t f = 0; f < frames_.size(); ++f) {
            const std::string& trouble = found_.coarse[f].trouble;
            if (!trouble.empty()) throw InputError(frames_[f].name, trouble);
        }
        throw InputError(fmt::format("{} frames at least are needed to find a stone, not {}",
                                     k_least_frames, found_.used.size()));
    }

    // Tries both senses of turning; the camera looks down.
    void find_turntable() {
        const double step =
            step_ != 0 ? std::abs(step_) : 2 * std::numbers::pi / double(frames_.size());
        std::vector<OutlineHull> hulls;
        for (const std::size_t f : found_.used) hulls.push_back({found_.coarse[f].corners});
        TangencyOptions options;
        options.from_above = true;
        options.turn_sigma = k_turn_sigma;
        for (const double deg : {3, 20, 35, 50, 65, 80}) options.elevations.push_back(radians(deg));
        Tangency best;
        for (const double sense : {1.0, -1.0}) {
            std::vector<double> turns;
            for (const std::size_t f : found_.used) turns.push_back(sense * step * double(f));
            const Tangency found = tangency_of(hulls, turns, options);
            if (!best.turns.empty() && found.residual_px >= best.residual_px) continue;
            best = found;
            found_.step = sense * step;
        }
        find_faults(best, options);
        found_.tangent_px = best.residual_px;
        found_.fit.series = {{best.table[0], best.table[1], best.table[2], 0}, best.turns};
        found_.expected.turn_sigma = k_turn_sigma;
        found_.expected.turns = best.expected.turns;
    }

    void find_faults(const Tangency& found, const TangencyOptions& options) {
        std::vector<std::string> names;
        std::vector<CoarseOutline> outlines;
        for (const std::size_t f : found_.used) {
            names.push_back(frames_[f].name);
            outlines.push_back(found_.coarse[f]);
        }
        found_.faults = faults_of_series(found, options, found_.step, names, outlines);
        found_.step *= found.expected.scale;
    }

    void fit_coarse_outlines() {
        try {
            found_.fit =
                fitted([&](std::size_t f) { return places_along(found_.coarse[f].corners); });
        } catch (const InputError&) {
            const SeriesFaults cut = cut_out(frames_, found_.coarse);
            if (cut.trouble.empty()) throw;
            throw InputError(cut.trouble + ". " + cut.remedy);
        }
    }

    // Grain on the ground tells camera and turns far better than the stone, if there is any.
    void look_at_ground() {
        std::vector<const LevelPicture*> pictures;
        std::vector<std::vector<glm::dvec2>> stones;
        double deepest = 0;
        for (const std::size_t f : found_.used) {
            pictures.push_back(&frames_[f].picture);
            stones.push_back(found_.coarse[f].corners);
            for (const glm::dvec2& c : found_.coarse[f].corners)
                deepest = std::max(deepest, glm::length(c));
        }
        found_.ground = ground_texture(pictures, stones, found_.fit.series, deepest);
        if (!found_.ground.found()) return;
        const TurningSeries& series = found_.ground.series;
        found_.expected = {series.camera, k_ground_sigmas, series.turns, k_ground_turn_sigma};
        found_.expected.sigmas[3] /= deepest;
        found_.fit.series = series;
        found_.has_ground = true;
    }

    // `every`: of the frames used, from `first`.
    template <class Points>
    TurningFit fitted(const Points& points, std::size_t first = 0, std::size_t every = 1) const {
        TurningOutlines given;
        given.start.camera = found_.fit.series.camera;
        given.expected = found_.expected;
        given.expected.turns.clear();
        for (std::size_t k = first; k < found_.used.size(); k += every) {
            given.outlines.push_back(points(found_.used[k]));
            given.expected.turns.push_back(found_.expected.turns[k]);
            given.start.turns.push_back(found_.fit.series.turns[k]);
        }
        for (const Facet& facet : found_.fit.solid.facets) given.planes.push_back(facet.plane);
        return fit_turning(given);
    }

    void refit(double reach, bool anew = false) {
        tbb::parallel_for(std::size_t{0}, found_.used.size(), [&](std::size_t k) {
            const std::size_t f = found_.used[k];
            found_.edges[f] =
                found_.edges_at(frames_[f].picture, found_.fit.series.turns[k], reach);
        });
        // Planes of the coarse outlines have followed the errors of camera and turns.
        if (anew) found_.fit.solid = {};
        found_.fit = fitted([&](std::size_t f) { return found_.edges[f]; });
    }

    const std::vector<SpinFrame>& frames_;
    const double step_;
    const Progress& progress_;
    SeriesOutlines found_;
};

}  // namespace

PicturePoints SeriesOutlines::edges_at(const LevelPicture& picture, double turn,
                                       double reach) const {
    return edge_points(picture, outline_in_picture(fit.solid.vertices, fit.series.camera, turn),
                       reach);
}

SeriesOutlines series_outlines(const std::vector<SpinFrame>& frames, double step,
                               const Progress& progress) {
    return OutlineStage(frames, step, progress).run();
}

}  // namespace culet
