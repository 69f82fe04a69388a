#pragma once
// Where a rendered picture goes, and how it is shown there.

#include <filesystem>
#include <optional>
#include <string>

#include "render/image/image_io.h"
#include "render/scene/scene.h"

namespace culet {

class PictureOutput {
public:
    /// `out`: .exr, .png or .hdr; "-" is stdout, as PNG; empty: nowhere. Throws InputError for
    /// other endings, a place that cannot be written, and a terminal.
    PictureOutput(std::string out, bool spectral);

    /// As shown_picture.h says. Throws InputError.
    void look_as(const std::string& exposure, const std::string& tonemap, const Scene& scene);

    /// The factor that a picture is shown with.
    double exposure_of(const Picture& picture) const;

    bool goes_to_a_file() const { return !out_.empty() && out_ != "-"; }
    /// Whole or not at all; what was there is replaced.
    void write(const Picture& picture,
               const std::vector<std::pair<std::string, std::string>>& text) const;

private:
    std::string out_;
    std::optional<double> exposure_ = 1;  ///< none: to the stone
    PngLook look_;
};

}  // namespace culet
