#include "app/render/picture_output.h"

#include <unistd.h>

#include <cstdio>

#include "app/program/scratch_folder.h"
#include "render/image/exposure.h"
#include "render/scene/shown_picture.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

}  // namespace

PictureOutput::PictureOutput(std::string out, bool spectral) : out_(std::move(out)) {
    if (out_ == "-") {
        if (isatty(STDOUT_FILENO) != 0)
            throw InputError("a terminal cannot show a picture: name a file, or redirect stdout");
        if (spectral) throw InputError("spectral planes need an .exr file");
        return;
    }
    if (out_.empty()) return;
    const std::string extension = fs::path(out_).extension().string();
    if (extension != ".exr" && extension != ".png" && extension != ".hdr")
        throw InputError(out_, "pictures are written as .exr, .png or .hdr");
    if (spectral && extension != ".exr")
        throw InputError(out_, "spectral planes need an .exr file");
    require_writable(out_);
}

void PictureOutput::look_as(const std::string& exposure, const std::string& tonemap,
                            const Scene& scene) {
    look_ = look_of(scene, tonemap);
    exposure_ = shown_exposure(exposure, scene);
}

double PictureOutput::exposure_of(const Picture& picture) const {
    return exposure_ ? *exposure_ : exposure_for_stone(picture, look_.share_over_white);
}

void PictureOutput::write(const Picture& picture,
                          const std::vector<std::pair<std::string, std::string>>& text) const {
    if (out_.empty()) return;
    PngLook look = look_;
    look.exposure = exposure_of(picture);
    if (out_ != "-") return write_picture(picture, out_, look, text);
    const ScratchFolder folder;
    const fs::path file = folder.path() / "picture.png";
    write_picture(picture, file, look, text);
    const std::string bytes = read_text(file);
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() ||
        std::fflush(stdout) != 0)
        throw InputError("stdout took only a part of the picture");
}

}  // namespace culet
