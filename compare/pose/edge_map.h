#pragma once
// A photograph's edges as distance maps, one for each direction, for comparison with many thousands
// of wireframes.

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "compare/pose/stone_view.h"

namespace culet {

constexpr int k_edge_directions = 12;

/// For a photograph resized to about `k_map_diameter` across the stone.
class EdgeMap {
public:
    /// `colour`: CV_32FC3, linear; `mask`: CV_8U, the stone. `reach`: of an edge, as a share of the
    /// stone's `diameter_px`.
    EdgeMap(const cv::Mat& colour, const cv::Mat& mask, double diameter_px, double reach);

    class Direction {
    public:
        /// 1 on an edge of this direction, falling to 0 at `reach`, minus the mean over the stone.
        float agreement(const PicturePoint& at) const {
            const int x = static_cast<int>(at.x * scale_), y = static_cast<int>(at.y * scale_);
            if (x < 0 || y < 0 || x >= near_.cols || y >= near_.rows) return -chance_;
            return near_.at<float>(y, x) - chance_;
        }

    private:
        friend class EdgeMap;
        Direction(const cv::Mat& near, float chance, double scale)
            : near_(near), chance_(chance), scale_(scale) {}
        const cv::Mat& near_;
        float chance_;
        double scale_;
    };
    /// For lines with this unit normal.
    Direction direction(double normal_x, double normal_y) const {
        const auto k = static_cast<std::size_t>(direction_of(normal_x, normal_y));
        return {near_[k], chance_[k], scale_};
    }
    /// Standard deviation of `agreement` over the stone.
    double spread() const { return spread_; }
    /// In pixels of the photograph.
    double pixel() const { return 1 / scale_; }

private:
    static int direction_of(double normal_x, double normal_y);
    std::array<cv::Mat, k_edge_directions> near_;
    std::array<float, k_edge_directions> chance_{};
    double scale_ = 1, spread_ = 0;
};

}  // namespace culet
