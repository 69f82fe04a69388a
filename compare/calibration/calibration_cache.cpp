#include "compare/calibration/calibration_cache.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <system_error>

#include "compare/scores/score_list.h"
#include "stone/errors.h"
#include "stone/output_file.h"

namespace culet {

namespace {

// Does any draw have the score that the kept directions are for?
bool has_tilts(const Calibration& calibration) {
    const auto key = std::find(calibration.keys.begin(), calibration.keys.end(), k_facet_tilts);
    if (key == calibration.keys.end()) return false;
    const auto k = static_cast<std::size_t>(key - calibration.keys.begin());
    return std::any_of(calibration.draws.begin(), calibration.draws.end(),
                       [&](const CalibrationDraw& draw) { return draw.scores[k].has_value(); });
}

std::optional<TiltVariance> tilts_from(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return std::nullopt;
    try {
        const cv::Mat rows = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
        if (rows.type() != CV_32FC1 || !cv::checkRange(rows)) return std::nullopt;
        return TiltVariance({rows.begin<float>(), rows.end<float>()},
                            static_cast<std::size_t>(rows.cols));
    } catch (const cv::Exception&) {
        return std::nullopt;
    }
}

}  // namespace

std::filesystem::path CalibrationCache::file_of(const std::string& hash,
                                                const char* extension) const {
    return folder_ / ("calibration-" + hash + extension);
}

std::optional<KeptCalibration> CalibrationCache::find(const std::string& hash) const {
    const std::filesystem::path file = file_of(hash, ".json");
    std::error_code ignored;
    if (folder_.empty() || !std::filesystem::exists(file, ignored)) return std::nullopt;
    try {
        auto calibration = calibration_from(read_text(file));
        if (!calibration || calibration->hash != hash || !calibration->complete()) {
            return std::nullopt;
        }
        calibration->from_cache = true;
        auto tilts = tilts_from(file_of(hash, ".exr"));
        if (!tilts && has_tilts(*calibration)) return std::nullopt;
        return KeptCalibration{std::move(*calibration), tilts ? std::move(*tilts) : TiltVariance()};
    } catch (const InputError&) {
        return std::nullopt;
    }
}

void CalibrationCache::keep(const Calibration& calibration, const TiltVariance& tilts) const {
    if (folder_.empty() || !calibration.complete()) return;
    std::error_code ignored;
    std::filesystem::create_directories(folder_, ignored);
    if (tilts.usable()) {
        const auto samples = static_cast<int>(tilts.samples());
        const cv::Mat rows(static_cast<int>(tilts.rows().size() / tilts.samples()), samples, CV_32F,
                           const_cast<float*>(tilts.rows().data()));
        try {
            OutputFile file(file_of(calibration.hash, ".exr"));
            if (!cv::imwrite(file.path().string(), rows)) return;
            file.commit();
        } catch (const cv::Exception&) {
            return;  // this OpenCV writes no EXR: nothing is kept
        }
    }
    write_text(file_of(calibration.hash, ".json"), calibration_json(calibration));
}

}  // namespace culet
