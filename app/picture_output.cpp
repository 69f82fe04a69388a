#include "app/picture_output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstdio>

#include "app/scratch_folder.h"
#include "render/image/exposure.h"
#include "render/scene/film_io.h"
#include "render/scene/light_presets.h"
#include "stone/errors.h"
#include "stone/output_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

}  // namespace

PictureOutput::PictureOutput(std::string out, bool spectral) : out_(std::move(out)) {
    if (out_ == "-") {
        if (isatty(STDOUT_FILENO) != 0)
            throw InputError("a picture is nothing for a terminal: name a file, or send stdout on");
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
    look_ = scene.film;
    look_.degrees_per_pixel = degrees_per_pixel(scene.camera);
    if (const auto map = tone_map_named(tonemap)) look_.tone_map = *map;
    if (exposure.empty()) {
        const LightPreset* preset = find_light_preset(scene.light_preset);
        if (preset != nullptr && !preset->instrument) exposure_.reset();
    } else if (exposure == "auto") {
        exposure_.reset();
    } else {
        double factor = 0;
        const char* const end = exposure.data() + exposure.size();
        const auto [stop, problem] = std::from_chars(exposure.data(), end, factor);
        if (problem != std::errc() || stop != end || !(factor > 0) || !std::isfinite(factor)) {
            throw InputError(fmt::format(
                "--exposure is auto, or a factor on linear light above 0, found \"{}\"", exposure));
        }
        exposure_ = factor;
    }
}

double PictureOutput::exposure_of(const Picture& picture) const {
    return exposure_ ? *exposure_ : exposure_for_stone(picture);
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
