#include "compare/calibration/pose_search.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "compare/calibration/cropped_camera.h"
#include "compare/scores/aligned_pair.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_searched_across = 160;  // pixels across the stone; enough for a blur of 2 %
// Reflexes a few degrees off still overlap after a blur of 4 % of the diameter; the last steps
// compare finer ones.
constexpr double k_wide_blur = 0.04, k_fine_blur = 0.02;
constexpr double k_finest = radians(0.1);  // the last step; the view's error is about half of it
constexpr int k_most_moves = 4;            // at one step

struct Tilt {
    double x = 0, y = 0;  // about the picture's axes, radians
};

class Views {
public:
    Views(const Photo& photo, const Scene& scene, const DraftRenderer& renderer,
          const PoseSearch& search)
        : photo_(photo),
          scene_(scene),
          renderer_(renderer),
          search_(search),
          start_(stone_view(scene.camera, centroid(scene.stone.solid))) {}

    Camera camera(const Tilt& tilt) const {
        return camera_of(changed(start_, {tilt.x, tilt.y}), scene_.camera);
    }

    /// The agreement of each tilt, computed in parallel.
    std::vector<double> agreements(const std::vector<Tilt>& tilts, double blur) {
        std::vector<double> result(tilts.size(), -1.0);
        tbb::task_arena arena(search_.threads > 0 ? search_.threads : tbb::task_arena::automatic);
        arena.execute([&] {
            tbb::parallel_for(std::size_t{0}, tilts.size(), [&](std::size_t i) {
                result[i] = agreement(camera(tilts[i]), blur);
            });
        });
        drawn += static_cast<int>(tilts.size());
        return result;
    }

    int drawn = 0;

private:
    double agreement(const Camera& camera, double blur) const {
        Scene scene = scene_;
        scene.camera =
            cropped_to_stone(camera, scene.stone.solid, k_searched_across, k_stone_margin);
        const AlignedPair pair = aligned(photo_, renderer_.draw(scene), k_searched_across);
        if (!pair.enough()) return -1;
        return zncc(pair.pictures, blur).value_or(-1);
    }

    const Photo& photo_;
    const Scene& scene_;
    const DraftRenderer& renderer_;
    const PoseSearch& search_;
    StoneView start_;
};

/// Points of a hexagonal grid within `reach` of the middle, the middle first.
std::vector<Tilt> net(const Tilt& middle, double step, double reach) {
    std::vector<Tilt> points{middle};
    const int rings = static_cast<int>(reach / step + 1);
    for (int i = -2 * rings; i <= 2 * rings; ++i) {
        for (int j = -2 * rings; j <= 2 * rings; ++j) {
            const double x = step * (i + 0.5 * j), y = step * std::sqrt(0.75) * j;
            if ((i != 0 || j != 0) && std::hypot(x, y) <= 1.01 * reach)
                points.push_back({middle.x + x, middle.y + y});
        }
    }
    return points;
}

std::size_t best_of(const std::vector<double>& values) {
    return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) -
                                    values.begin());
}

}  // namespace

SearchedPose search_pose(const Photo& photo, const Scene& scene, const DraftRenderer& renderer,
                         const PoseSearch& search, const Progress& progress) {
    Views views(photo, scene, renderer, search);
    SearchedPose found;
    Tilt best;
    double step = search.reach / 2, reach = search.reach;
    while (true) {
        const bool first = reach > step;
        const double blur = first || step > radians(1) ? k_wide_blur : k_fine_blur;
        for (int move = 0; move < k_most_moves; ++move) {
            if (progress && !progress(search.reach > 0 ? 1 - step / search.reach : 0))
                throw Interrupted();
            const std::vector<Tilt> tilts = net(best, step, reach);
            const std::vector<double> values = views.agreements(tilts, blur);
            const std::size_t at = best_of(values);
            best = tilts[at];
            found.agreement = values[at];
            if (first || at == 0) break;
        }
        step /= 2;
        reach = step;
        if (step < k_finest) break;
    }
    found.camera = views.camera(best);
    found.moved = std::hypot(best.x, best.y);
    found.drawn = views.drawn;
    return found;
}

}  // namespace culet
