#pragma once
// A file's EXIF data (EXIF 2.3, CIPA DC-008), read by libexif, which checks lengths.

#include <memory>
#include <string>
#include <string_view>

namespace culet {

class ExifFields {
public:
    /// `bytes`: a JPEG from its start, a TIFF, or a block that begins with "Exif" or like a TIFF.
    /// Damaged data count as none.
    explicit ExifFields(std::string_view bytes);

    /// Value of a tag (EXIF_TAG_...) in any format, ignoring the thumbnail's tags; NaN if missing.
    double number(int tag) const;
    /// At most 80 characters; non-ASCII ones become `?`.
    std::string text(int tag) const;
    /// 1 to 8 as in the standard; 1 if missing.
    int orientation() const;
    /// True for Adobe RGB (DCF 2.0's optional colour space, `R03`).
    bool adobe_rgb() const;

private:
    std::shared_ptr<void> data_;
};

}  // namespace culet
