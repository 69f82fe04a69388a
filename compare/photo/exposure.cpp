#include "compare/photo/exposure.h"

#include <fmt/format.h>
#include <libexif/exif-data.h>

#include <charconv>
#include <cmath>
#include <memory>

#include "stone/errors.h"

namespace culet {

namespace {

struct Release {
    void operator()(ExifData* data) const { exif_data_unref(data); }
};

// One number of an entry, whatever its format; NaN when it has none.
double number_in(ExifData* data, ExifTag tag) {
    for (int ifd = 0; ifd < EXIF_IFD_COUNT; ++ifd) {
        const ExifEntry* entry = exif_content_get_entry(data->ifd[ifd], tag);
        if (entry == nullptr || entry->components < 1 || ifd == EXIF_IFD_1) continue;
        const ExifByteOrder order = exif_data_get_byte_order(data);
        if (entry->size < exif_format_get_size(entry->format)) continue;
        switch (entry->format) {
            case EXIF_FORMAT_SHORT:
                return exif_get_short(entry->data, order);
            case EXIF_FORMAT_LONG:
                return exif_get_long(entry->data, order);
            case EXIF_FORMAT_RATIONAL: {
                const ExifRational r = exif_get_rational(entry->data, order);
                return r.denominator == 0 ? std::nan("")
                                          : static_cast<double>(r.numerator) / r.denominator;
            }
            case EXIF_FORMAT_SRATIONAL: {
                const ExifSRational r = exif_get_srational(entry->data, order);
                return r.denominator == 0 ? std::nan("")
                                          : static_cast<double>(r.numerator) / r.denominator;
            }
            default:
                break;
        }
    }
    return std::nan("");
}

std::string text_in(ExifData* data, ExifTag tag) {
    const ExifEntry* entry = exif_data_get_entry(data, tag);
    if (entry == nullptr || entry->format != EXIF_FORMAT_ASCII) return {};
    std::string text(reinterpret_cast<const char*>(entry->data), entry->size);
    text = text.substr(0, text.find('\0'));
    while (!text.empty() && text.back() == ' ') text.pop_back();
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
    return text.substr(0, 80);
}

double positive(double value) {
    return std::isfinite(value) && value > 0 ? value : 0;
}

}  // namespace

ShotData shot_data(std::string_view bytes) {
    ShotData shot;
    // libexif reads a JPEG from its start, or an EXIF block; a TIFF is one without its mark.
    std::string block;
    constexpr std::size_t k_most = 60000;
    if (bytes.starts_with("II*") || bytes.starts_with("MM")) {
        block = std::string("Exif\0\0", 6) + std::string(bytes.substr(0, k_most));
        bytes = block;
    }
    const std::unique_ptr<ExifData, Release> data(exif_data_new_from_data(
        reinterpret_cast<const unsigned char*>(bytes.data()),
        static_cast<unsigned>(std::min<std::size_t>(bytes.size(), 1u << 30))));
    if (data == nullptr) return shot;
    const double apex = number_in(data.get(), EXIF_TAG_SHUTTER_SPEED_VALUE);
    shot.seconds = positive(number_in(data.get(), EXIF_TAG_EXPOSURE_TIME));
    // The APEX value is the exact one where it means the same shot: within a third of a stop.
    if (std::isfinite(apex) && std::abs(apex) < 30) {
        const double exact = std::exp2(-apex);
        if (shot.seconds == 0 || std::abs(std::log2(exact / shot.seconds)) < 0.34)
            shot.seconds = exact;
    }
    shot.f_number = positive(number_in(data.get(), EXIF_TAG_FNUMBER));
    shot.iso = positive(number_in(data.get(), EXIF_TAG_ISO_SPEED_RATINGS));
    shot.focal_mm = positive(number_in(data.get(), EXIF_TAG_FOCAL_LENGTH));
    shot.focal_35mm = positive(number_in(data.get(), EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM));
    const double orientation = number_in(data.get(), EXIF_TAG_ORIENTATION);
    if (orientation >= 1 && orientation <= 8) shot.orientation = static_cast<int>(orientation);
    shot.camera = text_in(data.get(), EXIF_TAG_MAKE);
    const std::string model = text_in(data.get(), EXIF_TAG_MODEL);
    if (!model.empty()) shot.camera += (shot.camera.empty() ? "" : " ") + model;
    // 0: normal. 1: by the standard "custom"; 2 to 8 are what phones write for HDR, panoramas and
    // portraits.
    const double custom = number_in(data.get(), EXIF_TAG_CUSTOM_RENDERED);
    if (custom >= 1 && custom <= 8)
        shot.processed = "its EXIF says that the camera processed it (HDR, night, portrait, ...)";
    const std::string software = text_in(data.get(), EXIF_TAG_SOFTWARE);
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
            fmt::format("\"{}\" is no exposure: write seconds, 1/125 or 0.008, or "
                        "stops against the first, -2EV",
                        text));
    }
    return value;
}

}  // namespace culet
