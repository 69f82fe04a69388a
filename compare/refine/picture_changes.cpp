#include "compare/refine/picture_changes.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "compare/photo/in_batches.h"
#include "compare/refine/plane_moves.h"

namespace culet {

namespace {

constexpr double k_angle_step = radians(0.1);  // of the set-up

cv::Mat sketched(const SketchedStone& stone, const Solid& solid, const SetUp& set_up) {
    return stone.samples.sketched(
        *stone.renderer.sketch(set_up_scene(stone.samples.scene, solid, set_up, stone.middle)),
        stone.camera, stone.blur);
}

}  // namespace

PictureChanges picture_changes(const SketchedStone& stone, const cv::Mat& mask, int threads,
                               const Progress& progress) {
    const std::vector<FacetMoves> facets = moves_of(stone.solid);
    const std::size_t moves = k_moves_of_a_facet * facets.size(), all = moves + k_set_up_angles;
    const cv::Mat still = sketched(stone, stone.solid, stone.set_up);
    PictureChanges changes;
    changes.slopes.resize(all);
    changes.second_differences.resize(all);
    const auto change = [&](std::size_t k) {
        cv::Mat either[2];
        const double step = k < moves ? k_move_step : k_angle_step;
        for (const int side : {0, 1}) {
            const double amount = side ? -step : step;
            if (k < moves) {
                const std::size_t f = k / k_moves_of_a_facet;
                const auto moved =
                    with_plane_moved(stone.solid, f, facets[f], k % k_moves_of_a_facet, amount);
                either[side] = moved ? sketched(stone, *moved, stone.set_up) : still;
            } else {
                SetUp other = stone.set_up;
                angle_of(other, k - moves) += amount;
                either[side] = sketched(stone, stone.solid, other);
            }
        }
        changes.slopes[k] = samples_of((either[0] - either[1]) / (2 * step), mask);
        changes.second_differences[k] = samples_of(either[0] + either[1] - 2 * still, mask);
    };
    in_batches(all, threads, progress, change);
    return changes;
}

}  // namespace culet
