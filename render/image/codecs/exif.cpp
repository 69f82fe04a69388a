#include "render/image/codecs/exif.h"

#include <libexif/exif-data.h>

#include <algorithm>
#include <cmath>

namespace culet {

namespace {

ExifData* data_of(const std::shared_ptr<void>& data) {
    return static_cast<ExifData*>(data.get());
}

std::string text_of(const ExifEntry* entry) {
    if (entry == nullptr || entry->format != EXIF_FORMAT_ASCII) return {};
    std::string text(reinterpret_cast<const char*>(entry->data), entry->size);
    text = text.substr(0, text.find('\0'));
    while (!text.empty() && text.back() == ' ') text.pop_back();
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
    return text.substr(0, 80);
}

}  // namespace

ExifFields::ExifFields(std::string_view bytes) {
    // libexif reads a JPEG from its start, or an EXIF block: a TIFF after the mark "Exif".
    std::string block;
    constexpr std::size_t k_most = 60000;
    if (bytes.starts_with("II*") || bytes.starts_with("MM")) {
        block = std::string("Exif\0\0", 6) + std::string(bytes.substr(0, k_most));
        bytes = block;
    }
    ExifData* const data = exif_data_new();
    if (data == nullptr) return;
    data_.reset(data, exif_data_unref);
    // Otherwise libexif adds the standard's mandatory tags with its own values.
    exif_data_unset_option(data, EXIF_DATA_OPTION_FOLLOW_SPECIFICATION);
    exif_data_load_data(data, reinterpret_cast<const unsigned char*>(bytes.data()),
                        static_cast<unsigned>(std::min<std::size_t>(bytes.size(), 1u << 30)));
}

double ExifFields::number(int tag) const {
    ExifData* const data = data_of(data_);
    for (int ifd = 0; data != nullptr && ifd < EXIF_IFD_COUNT; ++ifd) {
        const ExifEntry* entry = exif_content_get_entry(data->ifd[ifd], static_cast<ExifTag>(tag));
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

std::string ExifFields::text(int tag) const {
    ExifData* const data = data_of(data_);
    if (data == nullptr) return {};
    return text_of(exif_data_get_entry(data, static_cast<ExifTag>(tag)));
}

int ExifFields::orientation() const {
    const double value = number(EXIF_TAG_ORIENTATION);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
}

bool ExifFields::adobe_rgb() const {
    ExifData* const data = data_of(data_);
    // The GPS directory has another tag of the same number.
    return data != nullptr &&
           text_of(exif_content_get_entry(data->ifd[EXIF_IFD_INTEROPERABILITY],
                                          EXIF_TAG_INTEROPERABILITY_INDEX)) == "R03";
}

}  // namespace culet
