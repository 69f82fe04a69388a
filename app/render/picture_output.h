#pragma once
// Writes a rendered picture with its exposure and tone mapping.

#include <filesystem>
#include <optional>
#include <string>

#include "render/image/image_io.h"
#include "render/scene/scene.h"

namespace culet {

class PictureOutput {
public:
    /// `out`: .exr, .png or .hdr; "-": stdout, as PNG; empty: nowhere. Throws InputError for other
    /// extensions, unwritable places, and a terminal.
    PictureOutput(std::string out, bool spectral);

    /// Options as in shown_picture.h. Throws InputError.
    void look_as(const std::string& exposure, const std::string& tonemap, const Scene& scene);

    double exposure_of(const Picture& picture) const;

    bool goes_to_a_file() const { return !out_.empty() && out_ != "-"; }
    /// Writes completely or not at all; replaces an existing file.
    void write(const Picture& picture,
               const std::vector<std::pair<std::string, std::string>>& text) const;

private:
    std::string out_;
    std::optional<double> exposure_ = 1;  ///< empty: exposed for the stone
    PngLook look_;
};

}  // namespace culet
