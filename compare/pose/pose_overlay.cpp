#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"
#include "compare/pose/find_pose.h"
#include "compare/pose/wireframe.h"

namespace culet {

namespace {

// Fractional bits of drawn coordinates: a sixteenth of a pixel.
constexpr int k_shift = 4;
// Exaggeration of the drawn distances to edges.
constexpr double k_exaggerated = 10;
constexpr int k_least_size = 800;

const cv::Scalar k_outline_colour(255, 80, 60), k_crown_colour(60, 200, 255);
const cv::Scalar k_met_colour(120, 255, 90), k_missed_colour(255, 220, 0);

class Sheet {
public:
    Sheet(const Photo& photo, bool mirrored) {
        cv::Mat colour = colour_of(photo).clone();
        const double bright = quantile(luminance(colour), {}, 0.99);
        if (bright > 0) colour *= 1 / bright;
        // Dimmed, so that the lines stand out.
        encoded(colour).convertTo(pixels_, CV_8UC3, 0.8 * 255);
        if (mirrored) cv::flip(pixels_, pixels_, 1);
        scale_ = std::max(1, static_cast<int>(std::ceil(static_cast<double>(k_least_size) /
                                                        std::max(photo.width, photo.height))));
        if (scale_ > 1) cv::resize(pixels_, pixels_, {}, scale_, scale_, cv::INTER_NEAREST);
    }
    void line(double x0, double y0, double x1, double y1, const cv::Scalar& colour) {
        // An absurd pose may lie far outside: clip before converting to integers.
        const double far = 4e6;
        for (double v : {x0, y0, x1, y1}) {
            if (!(std::abs(v) < far / scale_)) return;
        }
        cv::line(pixels_, at(x0, y0), at(x1, y1), colour, 1, cv::LINE_AA, k_shift);
    }
    std::string png() const { return png_bytes(pixels_); }

private:
    cv::Point at(double x, double y) const {
        const auto fixed = [&](double v) {
            return static_cast<int>(std::lround((v * scale_ - 0.5) * (1 << k_shift)));
        };
        return {fixed(x), fixed(y)};
    }
    cv::Mat pixels_;
    int scale_ = 1;
};

}  // namespace

std::string pose_overlay(const Photo& photo, const Solid& solid, const FoundPose& pose) {
    Sheet sheet(photo, pose.mirrored);
    const WireSolid wire(solid);
    for (const WireEdge& edge : visible_edges(wire, stone_view(pose.camera, wire.middle))) {
        sheet.line(edge.from.x, edge.from.y, edge.to.x, edge.to.y,
                   edge.outline ? k_outline_colour : k_crown_colour);
    }
    for (const EdgeMark& mark : pose.marks) {
        if (!mark.offset_px || !(mark.outline || mark.counted)) continue;
        const double reach = k_exaggerated * *mark.offset_px;
        sheet.line(mark.at[0], mark.at[1], mark.at[0] + reach * mark.normal[0],
                   mark.at[1] + reach * mark.normal[1],
                   mark.counted ? k_met_colour : k_missed_colour);
    }
    return sheet.png();
}

}  // namespace culet
