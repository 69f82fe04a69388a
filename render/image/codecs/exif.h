#pragma once
// A file's EXIF data (EXIF 2.3, CIPA DC-008), read by libexif, which holds them against their own
// lengths.

#include <memory>
#include <string>
#include <string_view>

namespace culet {

class ExifFields {
public:
    /// Of a JPEG from its start, of a TIFF, or of a block that begins with "Exif" or as a TIFF
    /// does. Damaged data count as none.
    explicit ExifFields(std::string_view bytes);

    /// Of a tag (EXIF_TAG_...), whatever its format, not of the thumbnail's; NaN when there is
    /// none.
    double number(int tag) const;
    /// At most 80 characters, those beyond ASCII as `?`.
    std::string text(int tag) const;
    /// 1 to 8 as in the standard; 1 where it is not said.
    int orientation() const;
    /// The colours are those of Adobe RGB (DCF 2.0's optional colour space, `R03`).
    bool adobe_rgb() const;

private:
    std::shared_ptr<void> data_;
};

}  // namespace culet
