#include "compare/pose/pose_candidates.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>

#include "compare/pose/same_look.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr int k_views_each = 12;  // of the coarse search, for each chirality
constexpr int k_views_over = 6;   // of the stone turned over
constexpr int k_turned_from = 3;  // of these are turned all round
constexpr int k_turned_each = 8;
constexpr std::size_t k_refined = 24;
constexpr int k_most_fold = 16;  // largest order of symmetry about a stone's axis

void sort_by_score(std::vector<SeenView>& found) {
    std::stable_sort(found.begin(), found.end(), [](const SeenView& a, const SeenView& b) {
        return a.coarse.score > b.coarse.score;
    });
}

std::vector<Candidate> worth_refining(const PoseTask& task, const std::vector<SeenView>& found) {
    std::vector<Candidate> candidates;
    for (const SeenView& one : found) {
        const SeenView image = images_of(task, one.side, one.coarse.view).front();
        const bool known =
            std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& other) {
                return other.side == image.side &&
                       angle_between(other.view, image.coarse.view) < radians(k_same_view_deg);
            });
        if (!known) candidates.push_back({image.side, image.coarse.view, {}, {}, {}});
        if (candidates.size() >= k_refined) break;
    }
    return candidates;
}

/// Indices of the best few views of each side of the stone.
std::vector<std::size_t> best_of_each_side(const PoseTask& task,
                                           const std::vector<SeenView>& found) {
    std::vector<std::size_t> best;
    for (const bool over : {false, true}) {
        int left = over ? 1 : k_turned_from;
        for (std::size_t i = 0; i < found.size() && left > 0; ++i) {
            if (shows_other_side(task, found[i].coarse.view) != over) continue;
            best.push_back(i);
            --left;
        }
    }
    return best;
}

StoneView turned_over(const StoneView& view) {
    StoneView over = view;
    over.turn = view.turn * rotation_by({std::numbers::pi, 0, 0});
    return over;
}

}  // namespace

std::vector<Candidate> coarse_candidates(const PoseTask& task) {
    std::vector<SeenView> found;
    for (const auto& side : task.sides) {
        for (const CoarseView& view :
             search_views(target_of(task, *side), side->start, task.options.search, k_views_each,
                          task.progress))
            found.push_back({side.get(), view});
    }
    // Otherwise a photograph of the other side could be taken for this one.
    if (task.options.all_turns) {
        const PhotoSide& side = *task.sides.front();
        for (const CoarseView& view :
             search_views(target_of(task, side), turned_over(side.start), task.options.search,
                          k_views_over, task.progress))
            found.push_back({&side, view});
    }
    sort_by_score(found);
    report(task, 0.3);
    if (task.options.all_turns) {
        std::vector<SeenView> turned;
        const std::vector<std::size_t> from = best_of_each_side(task, found);
        for (const std::size_t i : from) {
            for (const auto& side : task.sides) {
                // A stone with mirror symmetry looks alike, mirrored, from the mirrored direction.
                StoneView view = found[i].coarse.view;
                if (side.get() != found[i].side) view.turn = mirrored_turn(view.turn);
                for (const CoarseView& one :
                     turned_views(target_of(task, *side), view, k_turned_each))
                    turned.push_back({side.get(), one});
            }
        }
        found.insert(found.end(), turned.begin(), turned.end());
        sort_by_score(found);
    }
    report(task, 0.4);
    return worth_refining(task, found);
}

std::vector<SeenView> images_of(const PoseTask& task, const PhotoSide* side,
                                const StoneView& view) {
    const glm::dmat3 flip(-1, 0, 0, 0, 1, 0, 0, 0, 1);
    std::vector<SeenView> images;
    for (const glm::dmat3& symmetry : task.symmetries) {
        const bool mirrors = glm::determinant(symmetry) < 0;
        SeenView image{side, {view, 0}};
        StoneView& there = image.coarse.view;
        there.turn = view.turn * glm::transpose(symmetry);
        if (mirrors) {
            if (task.sides.size() < 2) continue;
            image.side = task.sides[side == task.sides[0].get() ? 1 : 0].get();
            there.turn = flip * there.turn;
            there.at.x = task.start.width - view.at.x;
            there.sight.x = task.start.width - view.sight.x;
        }
        images.push_back(image);
    }
    std::stable_sort(images.begin(), images.end(), [](const SeenView& a, const SeenView& b) {
        return nearer_to_start(a.side, a.coarse.view, b.side, b.coarse.view);
    });
    return images;
}

std::optional<StoneView> meant_look_alike(const PoseTask& task, const PhotoSide& side,
                                          const StoneView& view) {
    std::optional<StoneView> nearest;
    for (int fold = 2; fold <= k_most_fold; ++fold) {
        for (int k = 1; k < fold; ++k) {
            StoneView turned = view;
            turned.turn = view.turn * rotation_by({0, 0, 2 * std::numbers::pi * k / fold});
            const double angle = angle_between(turned, side.start);
            if (angle > task.options.search ||
                (nearest && angle >= angle_between(*nearest, side.start)) ||
                !look_alike(task.wire, view, turned, false))
                continue;
            nearest = turned;
        }
    }
    return nearest;
}

bool nearer_to_start(const PhotoSide* a_side, const StoneView& a, const PhotoSide* b_side,
                     const StoneView& b) {
    if (a_side->mirrored != b_side->mirrored) return !a_side->mirrored;
    return angle_between(a, a_side->start) < angle_between(b, b_side->start);
}

bool shows_other_side(const PoseTask& task, const StoneView& view) {
    // Edge-on, a stone shows no side.
    const double start = task.sides.front()->start.turn[2].z;
    return std::abs(start) > 0.5 && view.turn[2].z * start < 0;
}

double angle_between(const StoneView& a, const StoneView& b) {
    return angle_of(a.turn * glm::transpose(b.turn));
}

}  // namespace culet
