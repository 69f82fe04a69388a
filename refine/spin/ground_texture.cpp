#include "refine/spin/ground_texture.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "refine/spin/ground_grain.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

using Landmark = GroundLandmark;

constexpr double k_cell = 1.5;  // pixels between places on the ground
constexpr std::size_t k_landmarks = 2500, k_landmarks_of_a_pair = 600;
constexpr int k_pairs = 8;
constexpr double k_depth_step = 2;  // pixels
constexpr double k_turn_reach = radians(1.5), k_turn_step = radians(0.1);
constexpr int k_choices = 3, k_most_steps = 30, k_camera = 5;
constexpr double k_still = 1e-5, k_least_part = 0.05;

void keep_strongest(std::vector<Landmark>& all, std::size_t most) {
    if (all.size() <= most) return;
    std::nth_element(
        all.begin(), all.begin() + std::ptrdiff_t(most), all.end(),
        [](const Landmark& a, const Landmark& b) { return std::abs(a.level) > std::abs(b.level); });
    all.resize(most);
}

class Texture {
public:
    Texture(const std::vector<const LevelPicture*>& pictures,
            const std::vector<std::vector<glm::dvec2>>& stones, const TurningSeries& start)
        : start_(start) {
        for (std::size_t f = 0; f < pictures.size(); ++f)
            grains_.push_back(ground_grain(*pictures[f], stones[f]));
        found_.series = start;
        const double radius = std::min(grains_[0].cols, grains_[0].rows) / 2.0;
        for (double y = -radius; y < radius; y += k_cell) {
            for (double x = -radius; x < radius; x += k_cell) {
                if (x * x + y * y < radius * radius) places_.emplace_back(x, y);
            }
        }
        sums_.assign(places_.size(), 0);
        counts_.assign(places_.size(), 0);
        radius_ = radius;
    }

    GroundTexture run(double deepest) {
        find_depth(deepest);
        chain_turns();
        for (int i = 0; i < k_choices; ++i) {
            choose_landmarks();
            sharpen();
        }
        take_agreement();
        return std::move(found_);
    }

private:
    GroundView view_of(std::size_t f) const {
        return {found_.series.camera, found_.series.turns[f], found_.depth};
    }

    // The strongest grains of one picture; `place` is in it.
    std::vector<Landmark> grains_of(std::size_t f) const {
        std::vector<Landmark> all;
        const cv::Mat& grain = grains_[f];
        for (int y = 0; y < grain.rows; ++y) {
            for (int x = 0; x < grain.cols; ++x) {
                const double level = double(grain.at<float>(y, x));
                if (std::isfinite(level))
                    all.push_back(
                        {{x - (grain.cols - 1) / 2.0, (grain.rows - 1) / 2.0 - y}, level});
            }
        }
        keep_strongest(all, k_landmarks_of_a_pair);
        return all;
    }

    // At the right depth the ground of one frame turns into that of the next but one.
    void find_depth(double deepest) {
        const std::size_t frames = grains_.size(),
                          every = std::max<std::size_t>(1, frames / k_pairs);
        std::vector<double> scores(std::size_t(deepest / k_depth_step) + 1, 0.0);
        for (std::size_t f = 0; f + 2 < frames; f += every) {
            const std::vector<Landmark> seen = grains_of(f);
            for (std::size_t d = 0; d < scores.size(); ++d) {
                const double depth = double(d) * k_depth_step;
                const GroundView view(start_.camera, start_.turns[f], depth);
                std::vector<Landmark> landmarks = seen;
                for (Landmark& l : landmarks) l.place = view.on_ground(l.place);
                scores[d] += best_match(landmarks, grains_[f + 2], start_.camera, depth,
                                        start_.turns[f + 2], k_turn_reach, k_turn_step)
                                 .correlation;
            }
        }
        const auto best = std::max_element(scores.begin(), scores.end());
        found_.depth = k_depth_step * double(best - scores.begin());
    }

    // Each frame by the ground as those before it show it.
    void chain_turns() {
        std::vector<double>& turns = found_.series.turns;
        for (std::size_t f = 0; f < grains_.size(); ++f) {
            if (f > 0) {
                const double about = turns[f - 1] + start_.turns[f] - start_.turns[f - 1];
                std::vector<Landmark> known;
                for (std::size_t i = 0; i < places_.size(); ++i) {
                    if (counts_[i] > 0) known.push_back({places_[i], sums_[i] / counts_[i]});
                }
                keep_strongest(known, k_landmarks);
                turns[f] = best_match(known, grains_[f], found_.series.camera, found_.depth, about,
                                      k_turn_reach, k_turn_step)
                               .turn;
            }
            add_frame(f);
        }
    }

    void add_frame(std::size_t f) {
        const GroundView view = view_of(f);
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const double level = grain_at(grains_[f], view.in_picture(places_[i]));
            if (!std::isfinite(level)) continue;
            sums_[i] += level;
            ++counts_[i];
        }
    }

    void choose_landmarks() {
        std::fill(sums_.begin(), sums_.end(), 0.0);
        std::fill(counts_.begin(), counts_.end(), 0);
        for (std::size_t f = 0; f < grains_.size(); ++f) add_frame(f);
        found_.landmarks.clear();
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (2 * counts_[i] > int(grains_.size()))
                found_.landmarks.push_back({places_[i], sums_[i] / counts_[i]});
        }
        keep_strongest(found_.landmarks, k_landmarks);
    }

    // Renews the landmarks' levels; returns their mean square.
    double contrast() {
        std::vector<GroundView> views;
        for (std::size_t f = 0; f < grains_.size(); ++f) views.push_back(view_of(f));
        double squares = 0;
        for (Landmark& l : found_.landmarks) {
            double sum = 0;
            int count = 0;
            for (std::size_t f = 0; f < views.size(); ++f) {
                const double level = grain_at(grains_[f], views[f].in_picture(l.place));
                if (!std::isfinite(level)) continue;
                sum += level;
                ++count;
            }
            l.level = count > 0 ? sum / count : 0;
            squares += l.level * l.level;
        }
        return squares / double(std::max<std::size_t>(1, found_.landmarks.size()));
    }

    // Camera, depth and turns at which the mean of all frames has the most contrast.
    void sharpen() {
        double best = contrast(), part = 0.5;
        for (int i = 0; i < k_most_steps && part > k_least_part; ++i) {
            const GroundTexture before = found_;
            step(part);
            const double now = contrast();
            if (now > best) {
                const bool is_still = now < best * (1 + k_still);
                best = now;
                part = std::min(1.0, 1.5 * part);
                if (is_still) return;
            } else {
                found_ = before;
                part /= 2;
            }
        }
    }

    void step(double part) {
        const int size = k_camera + int(grains_.size());
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
        Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size);
        for (std::size_t f = 0; f < grains_.size(); ++f) add_slopes(f, matrix, gradient);
        matrix(k_camera, k_camera) = 1e30;  // the first turn stays
        matrix.diagonal() *= 1 + 1e-6;
        const Eigen::VectorXd by =
            part * matrix.selfadjointView<Eigen::Lower>().ldlt().solve(gradient);
        if (!by.allFinite()) return;
        TurningCamera& camera = found_.series.camera;
        camera.axis += by(0);
        camera.roll += by(1);
        camera.elevation += by(2);
        camera.perspective += by(3);
        found_.depth += by(4);
        for (std::size_t f = 0; f < grains_.size(); ++f)
            found_.series.turns[f] += by(k_camera + int(f));
    }

    // Of the correlation of one frame with the mean (Lucas and Kanade 1981).
    void add_slopes(std::size_t f, Eigen::MatrixXd& matrix, Eigen::VectorXd& gradient) const {
        constexpr double k_angle = 1e-4;
        const std::array<double, k_camera + 1> steps{1, k_angle, k_angle, k_angle / radius_,
                                                     1, k_angle};
        const GroundView here = view_of(f);
        std::vector<GroundView> moved;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            TurningCamera c = found_.series.camera;
            std::array<double*, 4> parts{&c.axis, &c.roll, &c.elevation, &c.perspective};
            if (i < parts.size()) *parts[i] += steps[i];
            moved.emplace_back(c, found_.series.turns[f] + (i == 5 ? steps[i] : 0),
                               found_.depth + (i == 4 ? steps[i] : 0));
        }
        const auto row_of = [&](std::size_t i) {
            return Eigen::Index(i < std::size_t(k_camera) ? i : std::size_t(k_camera) + f);
        };
        for (const Landmark& l : found_.landmarks) {
            const glm::dvec2 at = here.in_picture(l.place);
            const auto level = [&](double x, double y) {
                return grain_at(grains_[f], at + glm::dvec2(x, y));
            };
            const glm::dvec2 slope(level(0.5, 0) - level(-0.5, 0), level(0, 0.5) - level(0, -0.5));
            if (!std::isfinite(slope.x + slope.y)) continue;
            std::array<double, k_camera + 1> by{};
            for (std::size_t i = 0; i < by.size(); ++i)
                by[i] = glm::dot(slope, moved[i].in_picture(l.place) - at) / steps[i];
            for (std::size_t a = 0; a < by.size(); ++a) {
                gradient(row_of(a)) += by[a] * l.level;
                for (std::size_t b = 0; b <= a; ++b) matrix(row_of(a), row_of(b)) += by[a] * by[b];
            }
        }
    }

    void take_agreement() {
        double mean = 0, all = 0;
        for (std::size_t f = 0; f < grains_.size(); ++f) {
            const GroundView view = view_of(f);
            for (const Landmark& l : found_.landmarks) {
                const double level = grain_at(grains_[f], view.in_picture(l.place));
                if (!std::isfinite(level)) continue;
                mean += l.level * l.level;
                all += level * level;
            }
        }
        found_.agreement = all > 0 ? mean / all : 0;
    }

    const TurningSeries& start_;
    std::vector<cv::Mat> grains_;
    std::vector<glm::dvec2> places_;
    std::vector<double> sums_;  // of the frames that show a place
    std::vector<int> counts_;
    GroundTexture found_;
    double radius_ = 0;
};

}  // namespace

GroundTexture ground_texture(const std::vector<const LevelPicture*>& pictures,
                             const std::vector<std::vector<glm::dvec2>>& stones,
                             const TurningSeries& start, double deepest) {
    return Texture(pictures, stones, start).run(deepest);
}

double turn_by_ground(const GroundTexture& ground, const LevelPicture& picture,
                      const std::vector<glm::dvec2>& stone, double about) {
    const cv::Mat grain = ground_grain(picture, stone);
    const auto best = [&](double from, double reach, double step) {
        return best_match(ground.landmarks, grain, ground.series.camera, ground.depth, from, reach,
                          step)
            .turn;
    };
    return best(best(about, k_turn_reach, k_turn_step), k_turn_step, k_turn_step / 20);
}

}  // namespace culet
