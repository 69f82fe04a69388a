#include "compare/photo/exposure.h"

#include <fmt/format.h>
#include <libexif/exif-tag.h>

#include <charconv>
#include <cmath>

#include "render/image/codecs/exif.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

double positive(double value) {
    return std::isfinite(value) && value > 0 ? value : 0;
}

}  // namespace

ShotData shot_data(std::string_view bytes) {
    ShotData shot;
    const ExifFields exif(bytes);
    const double apex = exif.number(EXIF_TAG_SHUTTER_SPEED_VALUE);
    shot.seconds = positive(exif.number(EXIF_TAG_EXPOSURE_TIME));
    // The APEX value is exact; use it if it agrees within a third of a stop.
    if (std::isfinite(apex) && std::abs(apex) < 30) {
        const double exact = std::exp2(-apex);
        if (shot.seconds == 0 || std::abs(std::log2(exact / shot.seconds)) < 0.34)
            shot.seconds = exact;
    }
    shot.f_number = positive(exif.number(EXIF_TAG_FNUMBER));
    shot.iso = positive(exif.number(EXIF_TAG_ISO_SPEED_RATINGS));
    shot.focal_mm = positive(exif.number(EXIF_TAG_FOCAL_LENGTH));
    shot.focal_35mm = positive(exif.number(EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM));
    shot.camera = exif.text(EXIF_TAG_MAKE);
    const std::string model = exif.text(EXIF_TAG_MODEL);
    if (!model.empty()) shot.camera += (shot.camera.empty() ? "" : " ") + model;
    // 0: normal; 1: "custom" in the standard; 2 to 8: phones' HDR, panoramas and portraits.
    const double custom = exif.number(EXIF_TAG_CUSTOM_RENDERED);
    if (custom >= 1 && custom <= 8)
        shot.processed = "its EXIF says that the camera processed it (HDR, night, portrait, ...)";
    const std::string software = exif.text(EXIF_TAG_SOFTWARE);
    if (software.find("HDR") != std::string::npos)
        shot.processed = fmt::format("its EXIF names the software {}", software);
    return shot;
}

std::optional<double> exposure_of(const ShotData& shot) {
    if (!(shot.seconds > 0)) return std::nullopt;
    double exposure = shot.seconds;
    if (shot.iso > 0) exposure *= shot.iso / 100;
    if (shot.f_number > 0) exposure /= shot.f_number * shot.f_number;
    return exposure;
}

double focal_px_of(const ShotData& shot, double diagonal_px) {
    constexpr double k_diagonal_35mm = 43.2666;
    return shot.focal_35mm > 0 ? shot.focal_35mm / k_diagonal_35mm * diagonal_px : 0;
}

std::string text_of(const ShotData& shot) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (shot.seconds >= 0.3) {
        add(fmt::format("{:.3g} s", shot.seconds));
    } else if (shot.seconds > 0) {
        add(fmt::format("1/{:.4g} s", 1 / shot.seconds));
    }
    if (shot.f_number > 0) add(fmt::format("f/{:.3g}", shot.f_number));
    if (shot.iso > 0) add(fmt::format("ISO {:.4g}", shot.iso));
    if (shot.focal_mm > 0) add(fmt::format("{:.4g} mm", shot.focal_mm));
    return text;
}

double parse_exposure(const std::string& text) {
    std::string word = text;
    while (!word.empty() && word.back() == ' ') word.pop_back();
    bool stops = false;
    for (const char* unit : {"EV", "ev", "s"}) {
        if (word.ends_with(unit)) {
            word.resize(word.size() - std::string_view(unit).size());
            stops = unit[0] != 's';
            break;
        }
    }
    while (!word.empty() && word.back() == ' ') word.pop_back();
    const auto number = [](std::string_view part) {
        double value = 0;
        if (part.starts_with('+')) part.remove_prefix(1);
        const auto [end, problem] = std::from_chars(part.data(), part.data() + part.size(), value);
        return problem == std::errc() && end == part.data() + part.size() ? value : std::nan("");
    };
    const std::size_t slash = word.find('/');
    double value = slash == std::string::npos
                       ? number(word)
                       : number(std::string_view(word).substr(0, slash)) /
                             number(std::string_view(word).substr(slash + 1));
    if (stops) value = std::exp2(value);
    if (!(std::isfinite(value) && value > 0)) {
        throw InputError(
            fmt::format("\"{}\" is not an exposure: write seconds, 1/125 or 0.008, or stops "
                        "against the first, -2EV",
                        text));
    }
    return value;
}

}  // namespace culet
