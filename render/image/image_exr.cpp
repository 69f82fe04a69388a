#include "render/image/image_exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "render/image/exr_channels.h"
#include "render/image/exr_file.h"
#include "render/image/linear_picture.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Returns the wavelength of `S0.589,300nm` (Fichet et al. 2021), or nothing for another channel.
std::optional<double> wavelength_of(std::string name) {
    if (!name.starts_with("S0.") || !name.ends_with("nm")) return std::nullopt;
    name = name.substr(3, name.size() - 5);
    std::replace(name.begin(), name.end(), ',', '.');
    double nm = 0;
    const auto [end, problem] = std::from_chars(name.data(), name.data() + name.size(), nm);
    if (problem != std::errc() || end != name.data() + name.size() || !std::isfinite(nm))
        return std::nullopt;
    return nm;
}

// Address that pixel (0, 0) would have, given the address of the window's first pixel.
template <class Value>
Value* origin_of(Value* plane, const Imath::Box2i& window, std::size_t stride) {
    const std::ptrdiff_t before =
        (static_cast<std::ptrdiff_t>(window.min.y) * size_of(window).width + window.min.x) *
        static_cast<std::ptrdiff_t>(stride * sizeof(Value));
    return reinterpret_cast<Value*>(reinterpret_cast<std::uintptr_t>(plane) -
                                    static_cast<std::uintptr_t>(before));
}

// Reads channels of the data window into planes.
class ExrPlanes {
public:
    ExrPlanes(Imf::InputFile& input, const std::filesystem::path& file)
        : input_(input), file_(file), window_(input.header().dataWindow()) {}

    void add(const std::string& name, float* plane, std::size_t stride) {
        const Imf::Channel& channel = input_.header().channels()[name.c_str()];
        if (channel.xSampling != 1 || channel.ySampling != 1) {
            throw InputError(file_,
                             fmt::format("is an EXR whose channel {} is subsampled, which is "
                                         "read of RY and BY beside Y alone",
                                         name));
        }
        const std::size_t pixel = stride * sizeof(float);
        frame_.insert(
            name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(origin_of(plane, window_, stride)),
                             pixel, pixel * static_cast<std::size_t>(size_of(window_).width)));
    }
    void read() {
        if (frame_.begin() == frame_.end()) return;
        input_.setFrameBuffer(frame_);
        input_.readPixels(window_.min.y, window_.max.y);
    }

private:
    Imf::InputFile& input_;
    const std::filesystem::path& file_;
    Imath::Box2i window_;
    Imf::FrameBuffer frame_;
};

// Luminance and half-size colour differences, filtered by the library, which keeps 11 bits.
void read_chroma(const std::string& bytes, const std::filesystem::path& file, Picture& picture) {
    ExrStream stream(bytes, file.c_str());
    Imf::RgbaInputFile input(stream, 0);
    const Imath::Box2i window = input.dataWindow();
    std::vector<Imf::Rgba> pixels(picture.pixels());
    input.setFrameBuffer(origin_of(pixels.data(), window, 1), 1,
                         static_cast<std::size_t>(picture.width));
    input.readPixels(window.min.y, window.max.y);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        picture.rgb[3 * i] = pixels[i].r;
        picture.rgb[3 * i + 1] = pixels[i].g;
        picture.rgb[3 * i + 2] = pixels[i].b;
    }
}

void add_further_planes(const Imf::ChannelList& channels, ExrPlanes& planes, Picture& picture) {
    // Channels are sorted by name, wavelengths must be by number.
    std::map<double, std::string> spectral;
    for (auto c = channels.begin(); c != channels.end(); ++c) {
        if (const auto nm = wavelength_of(c.name())) spectral.emplace(*nm, c.name());
    }
    for (const auto& [nm, name] : spectral) {
        picture.wavelengths_nm.push_back(nm);
        picture.spectral.emplace_back(picture.pixels());
        planes.add(name, picture.spectral.back().data(), 1);
    }
    std::vector<std::string> further{"saturated"};
    further.insert(further.begin(), k_variance_channels.begin(), k_variance_channels.end());
    further.insert(further.end(), k_band_channels.begin(), k_band_channels.end());
    for (const std::string& name : further) {
        if (channels.findChannel(name.c_str()) != nullptr)
            picture.planes.push_back({name, std::vector<float>(picture.pixels())});
    }
    for (Picture::Plane& plane : picture.planes) planes.add(plane.channel, plane.values.data(), 1);
}

// Places the data window in the display window, which is the picture.
void place_window(const Imf::Header& header, const std::filesystem::path& file, ReadPicture& read) {
    const Imath::Box2i data = header.dataWindow(), shown = header.displayWindow();
    if (data == shown) return;
    const int left = data.min.x - shown.min.x, top = data.min.y - shown.min.y;
    const ExrWindow from = size_of(data), to = size_of(shown);
    const int first = std::max(left, 0), last = std::min(left + from.width, to.width),
              above = std::max(top, 0), below = std::min(top + from.height, to.height);
    if (first >= last || above >= below)
        throw InputError(file, "is an EXR whose data window lies outside of its display window");
    const auto placed = [&](std::vector<float>& plane, std::size_t channels) {
        if (plane.empty()) return;
        std::vector<float> whole(std::size_t(to.width) * std::size_t(to.height) * channels);
        for (int y = above; y < below; ++y) {
            const float* row = plane.data() + (std::size_t(y - top) * std::size_t(from.width) +
                                               std::size_t(first - left)) *
                                                  channels;
            std::copy_n(
                row, std::size_t(last - first) * channels,
                whole.data() +
                    (std::size_t(y) * std::size_t(to.width) + std::size_t(first)) * channels);
        }
        plane = std::move(whole);
    };
    Picture& picture = read.picture;
    picture.width = to.width;
    picture.height = to.height;
    placed(picture.rgb, 3);
    placed(picture.coverage, 1);
    for (auto& plane : picture.spectral) placed(plane, 1);
    for (Picture::Plane& plane : picture.planes) placed(plane.values, 1);
    if (first > 0 || above > 0 || last < to.width || below < to.height) {
        read.notes.push_back(
            fmt::format("it holds columns {} to {} and rows {} to {} of {} x {} pixels (data "
                        "window); the others "
                        "are 0",
                        first, last - 1, above, below - 1, to.width, to.height));
    }
}

Primaries primaries_of(const Imf::Header& header) {
    if (!Imf::hasChromaticities(header)) return k_srgb_primaries;
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    Imath::V2f white = c.white;
    if (Imf::hasAdoptedNeutral(header)) white = Imf::adoptedNeutral(header);
    const auto xy = [](const Imath::V2f& v) {
        return std::array<double, 2>{double(v.x), double(v.y)};
    };
    return {xy(c.red), xy(c.green), xy(c.blue), xy(white)};
}

ReadPicture read_checked_exr(const std::string& bytes, const std::filesystem::path& file) {
    ReadPicture read;
    read.encoding = "linear EXR";
    ExrStream stream(bytes, file.c_str());
    Imf::InputFile input(stream, 0);
    const Imf::Header& header = input.header();
    const Imf::ChannelList& channels = header.channels();
    const ExrColours colours = colours_in(channels, file);
    const ExrWindow size = size_of(header.dataWindow());
    Picture& picture = read.picture;
    picture.width = size.width;
    picture.height = size.height;
    picture.rgb.resize(3 * picture.pixels());
    if (!colours.layer.empty())
        read.notes.push_back(fmt::format("its layer {} is read", colours.layer));
    ExrPlanes planes(input, file);
    const bool grey = colours.kind == ExrColours::Kind::grey,
               chroma = colours.kind == ExrColours::Kind::chroma;
    for (std::size_t c = 0; c < (grey ? 1 : chroma ? 0 : 3); ++c)
        planes.add(colours.names[c], picture.rgb.data() + c, 3);
    read.had_alpha = !colours.alpha.empty();
    if (read.had_alpha) {
        picture.coverage.resize(picture.pixels());
        planes.add(colours.alpha, picture.coverage.data(), 1);
    }
    add_further_planes(channels, planes, picture);
    planes.read();
    if (chroma) read_chroma(bytes, file, picture);
    for (std::size_t i = 0; grey && i < picture.rgb.size(); i += 3)
        picture.rgb[i + 1] = picture.rgb[i + 2] = picture.rgb[i];
    if (colours.kind == ExrColours::Kind::xyz)
        turn_to_srgb(k_xyz_primaries, picture.rgb, read.notes);
    else if (!grey)
        turn_to_srgb(primaries_of(header), picture.rgb, read.notes);
    place_window(header, file, read);
    note_pixel_aspect(static_cast<double>(header.pixelAspectRatio()), read.notes);
    for (auto a = header.begin(); a != header.end(); ++a) {
        const std::string key = a.name();
        const auto* value = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
        if (key.starts_with("culet:") && value != nullptr)
            picture.text.emplace_back(key, value->value());
    }
    return read;
}

}  // namespace

std::string one_line(const char* what) {
    std::string text(what);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

ReadPicture read_exr(const std::string& bytes, const std::filesystem::path& file) {
    try {
        check_exr(bytes, file);
        return read_checked_exr(bytes, file);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(file,
                         fmt::format("is not an EXR that can be read: {}", one_line(error.what())));
    }
}

}  // namespace culet
