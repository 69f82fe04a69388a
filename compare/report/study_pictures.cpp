#include "compare/report/study_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/report/report_parts.h"
#include "stone/numbers/quantile.h"

namespace culet {

namespace {

// All but 1 % of the stone's pixels differ by less.
constexpr double k_shown_share = 0.99;

std::string uri_of(const Picture& picture, double white) {
    Photo photo;
    photo.width = picture.width;
    photo.height = picture.height;
    photo.rgb = picture.rgb;
    return picture_uri(photo, white);
}

// Rounded up to 1, 3, 10, ... so that few scales are in use.
double round_scale(const PixelMap& map) {
    std::vector<float> sizes;
    for (const float value : map.values) {
        if (std::isfinite(value)) sizes.push_back(std::abs(value));
    }
    if (sizes.empty()) return 1;
    const double size =
        std::max(1e-6, static_cast<double>(quantile(std::move(sizes), k_shown_share)));
    const double decade = std::pow(10, std::floor(std::log10(size)));
    return size <= decade ? decade : size <= 3 * decade ? 3 * decade : 10 * decade;
}

}  // namespace

std::vector<SceneStudyPicture> study_pictures(const SceneStudy& study) {
    std::vector<SceneStudyPicture> pictures;
    pictures.push_back({-1, uri_of(study.reference.picture, study.reference.white), {}, 0});
    for (const int id : study.front) {
        const StudiedRender& render = study.render(id);
        const double scale = round_scale(render.difference);
        pictures.push_back({id, uri_of(render.picture, study.reference.white),
                            map_uri(render.difference, ColourMap::difference, -scale, scale),
                            scale});
    }
    return pictures;
}

}  // namespace culet
