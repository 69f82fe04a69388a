#include "compare/scores/likeness.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"
#include "compare/scores/aligned_pair.h"
#include "compare/scores/rotation_null.h"
#include "compare/scores/score_list.h"

namespace culet {

namespace {

Score score_called(const std::string& key) {
    Score score;
    score.key = key;
    score.is_correlation = true;
    return score;
}

}  // namespace

Likeness likeness(const Photo& photo, const Photo& render, const std::vector<std::uint8_t>& stone,
                  int draws, std::uint64_t seed) {
    const cv::Mat inside(photo.height, photo.width, CV_8U, const_cast<std::uint8_t*>(stone.data()));
    MatchedPictures whole{colour_of(photo), colour_of(render), {}, 0, 1};
    whole.diameter = 2 * std::sqrt(cv::countNonZero(inside) / CV_PI);
    cv::erode(inside, whole.mask, cv::Mat(), {-1, -1},
              std::max(2, int(std::lround(0.005 * whole.diameter))));
    const cv::Rect part = part_to_score(whole);
    const MatchedPictures pictures = part_of(whole, part);
    Likeness result{score_called("zncc"), score_called("zncc_4pct")};
    const std::vector<double> blurs{0.02, 0.04};
    const auto scores = zncc(pictures, blurs);
    result.zncc.value = scores[0];
    result.coarse.value = scores[1];
    for (const Rotation& draw : draw_rotations(pictures, inside(part).clone(), draws, seed)) {
        const auto turned = zncc(rotated(pictures, draw), blurs);
        if (turned[0]) result.zncc.null.push_back(*turned[0]);
        if (turned[1]) result.coarse.null.push_back(*turned[1]);
    }
    fill_null(result.zncc);
    fill_null(result.coarse);
    return result;
}

Score mean_score(const std::vector<Score>& scores) {
    Score mean = score_called(scores.at(0).key);
    std::size_t draws = scores[0].null.size();
    const auto count = double(scores.size());
    double sum = 0;
    for (const Score& score : scores) {
        draws = std::min(draws, score.null.size());
        sum += score.value.value_or(0);
    }
    mean.value = sum / count;
    for (std::size_t k = 0; k < draws; ++k) {
        double turned = 0;
        for (const Score& score : scores) turned += score.null[k];
        mean.null.push_back(turned / count);
    }
    fill_null(mean);
    return mean;
}

}  // namespace culet
