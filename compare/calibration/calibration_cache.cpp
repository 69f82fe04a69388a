#include "compare/calibration/calibration_cache.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <variant>

#include "compare/scores/score_list.h"
#include "render/image/codecs/codecs.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

constexpr const char* k_tilts_extension = ".pfm";

// Whether any draw has the score for which the directions are kept.
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
        const DecodedPixels rows = decode_pfm(read_text(file), file);
        const auto& values = std::get<std::vector<float>>(rows.samples);
        const bool finite = std::all_of(values.begin(), values.end(),
                                        [](float value) { return std::isfinite(value); });
        if (rows.channels != 1 || !finite) return std::nullopt;
        return TiltVariance(values, static_cast<std::size_t>(rows.width));
    } catch (const InputError&) {
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
        if (!calibration || calibration->hash != hash) {
            return std::nullopt;
        }
        calibration->from_cache = true;
        auto tilts = tilts_from(file_of(hash, k_tilts_extension));
        if (!tilts && has_tilts(*calibration)) return std::nullopt;
        return KeptCalibration{std::move(*calibration), tilts ? std::move(*tilts) : TiltVariance()};
    } catch (const InputError&) {
        return std::nullopt;
    }
}

void CalibrationCache::keep(const Calibration& calibration, const TiltVariance& tilts) const {
    if (folder_.empty()) return;
    std::error_code ignored;
    std::filesystem::create_directories(folder_, ignored);
    if (tilts.usable()) {
        const std::size_t directions = tilts.rows().size() / tilts.samples();
        write_text(file_of(calibration.hash, k_tilts_extension),
                   encode_pfm(static_cast<int>(tilts.samples()), static_cast<int>(directions),
                              tilts.rows()));
    }
    write_text(file_of(calibration.hash, ".json"), calibration_json(calibration));
}

}  // namespace culet
