#include "render/image/image_exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>

#include "stone/errors.h"

namespace culet {

namespace {

constexpr long long k_most_exr_pixels = 1LL << 28;
constexpr long long k_most_samples = 1LL << 31;  // over all channels
constexpr long long k_tightest_exr = 20000;      // pixels a byte
constexpr unsigned k_most_tile_side = 8192;

// The library reads from files or from a stream of ours; bytes in memory are checked before they
// are read.
class MemoryStream : public Imf::IStream {
public:
    MemoryStream(const std::string& bytes, const char* name) : Imf::IStream(name), bytes_(bytes) {}
    bool read(char c[], int n) override {
        // Compared without adding: a place near 2^64, as a broken offset table gives, must not
        // wrap.
        if (n < 0 || at_ > bytes_.size() || static_cast<std::uint64_t>(n) > bytes_.size() - at_) {
            throw std::runtime_error("the file ends too early");
        }
        std::memcpy(c, bytes_.data() + at_, static_cast<std::size_t>(n));
        at_ += static_cast<std::uint64_t>(n);
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = position; }

private:
    const std::string& bytes_;
    std::uint64_t at_ = 0;
};

// The size a header states is checked before the library makes room for it: pictures, tiles and
// offset tables of a hostile header would take gigabytes.
void check_header(const Imf::Header& header, std::size_t bytes, const std::filesystem::path& file) {
    const Imath::Box2i window = header.dataWindow();
    const long long width = static_cast<long long>(window.max.x) - window.min.x + 1;
    const long long height = static_cast<long long>(window.max.y) - window.min.y + 1;
    if (width < 1 || height < 1 || width > k_most_exr_pixels || height > k_most_exr_pixels ||
        width * height > k_most_exr_pixels) {
        throw InputError(file, fmt::format("is an EXR of {} x {} pixels; up to 2^28 pixels are "
                                           "read",
                                           width, height));
    }
    long long channels = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++channels;
    if (channels > k_most_samples / (width * height)) {
        throw InputError(file, fmt::format("is an EXR of {} x {} pixels with {} channels, more "
                                           "than are read",
                                           width, height, channels));
    }
    // No codec packs a picture this tightly: the file is cut off.
    if (width * height / k_tightest_exr > static_cast<long long>(bytes)) {
        throw InputError(file, fmt::format("is an EXR of {} x {} pixels in {} bytes: it is cut off",
                                           width, height, bytes));
    }
    if (header.hasTileDescription() && (header.tileDescription().xSize > k_most_tile_side ||
                                        header.tileDescription().ySize > k_most_tile_side)) {
        throw InputError(
            file, fmt::format("is an EXR with tiles of {} x {} pixels, more than are "
                              "read",
                              header.tileDescription().xSize, header.tileDescription().ySize));
    }
}

// `S0.589,300nm` (Fichet et al. 2021): the wavelength, or nothing for any other channel.
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

std::string names_of(const Imf::ChannelList& channels) {
    std::string names;
    int count = 0;
    for (auto c = channels.begin(); c != channels.end() && count < 8; ++c, ++count)
        names += (names.empty() ? "" : ", ") + std::string(c.name());
    return names.empty() ? "none" : names;
}

// The library allocates what an attribute claims before it reads it: the claims of all headers are
// held against the file first (OpenEXR file layout: name, type, size, value; an empty name ends a
// header, and in a file of parts an empty header ends them).
void check_attributes(const std::string& bytes, const std::filesystem::path& file) {
    constexpr unsigned k_multi_part = 0x10, k_deep = 0x08;  // bits 12 and 11 of the version field
    const InputError cut_off(file, "is an EXR whose header is cut off");
    if (bytes.size() < 9) throw cut_off;
    const auto flags = static_cast<unsigned char>(bytes[5]);
    if ((flags & k_deep) != 0)
        throw InputError(file, "is a deep EXR, which is not read here: flatten it");
    std::size_t at = 8;
    for (bool first = true;; first = false) {
        const std::size_t start = at;
        while (at < bytes.size() && bytes[at] != 0) {
            for (int text = 0; text < 2; ++text) {
                at = bytes.find('\0', at);
                if (at == std::string::npos) throw cut_off;
                ++at;
            }
            if (bytes.size() - at < 4) throw cut_off;
            std::uint32_t size = 0;
            for (std::size_t i = 4; i-- > 0;)
                size = size << 8 | static_cast<unsigned char>(bytes[at + i]);
            at += 4;
            if (size > bytes.size() - at) throw cut_off;
            at += size;
        }
        if (at >= bytes.size()) throw cut_off;
        ++at;
        if ((flags & k_multi_part) == 0 || (!first && at == start + 1)) return;
    }
}

}  // namespace

std::string one_line(const char* what) {
    std::string text(what);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

Picture read_exr(const std::string& bytes, const std::filesystem::path& file, bool& had_alpha) {
    try {
        check_attributes(bytes, file);
        {
            MemoryStream stream(bytes, file.c_str());
            Imf::Header header;
            int version = 0;
            char magic[4];
            stream.read(magic, 4);
            stream.read(magic, 4);
            for (int i = 3; i >= 0; --i)
                version = version << 8 | static_cast<unsigned char>(magic[i]);
            header.readFrom(stream, version);
            check_header(header, bytes.size(), file);
        }
        MemoryStream stream(bytes, file.c_str());
        Imf::InputFile input(stream, 0);
        const Imath::Box2i window = input.header().dataWindow();
        const Imf::ChannelList& channels = input.header().channels();

        Picture picture;
        picture.width = window.max.x - window.min.x + 1;
        picture.height = window.max.y - window.min.y + 1;
        const std::size_t pixels = picture.pixels();
        Imf::FrameBuffer frame;
        const auto slice = [&](const std::string& name, float* plane, std::size_t stride) {
            const Imf::Channel* channel = channels.findChannel(name.c_str());
            if (channel->xSampling != 1 || channel->ySampling != 1) {
                throw InputError(file,
                                 "is an EXR with subsampled channels, which are not read here");
            }
            const std::ptrdiff_t before =
                (static_cast<std::ptrdiff_t>(window.min.y) * picture.width + window.min.x) *
                static_cast<std::ptrdiff_t>(stride * sizeof(float));
            char* base = reinterpret_cast<char*>(reinterpret_cast<std::uintptr_t>(plane) -
                                                 static_cast<std::uintptr_t>(before));
            frame.insert(
                name, Imf::Slice(Imf::FLOAT, base, stride * sizeof(float),
                                 stride * sizeof(float) * static_cast<std::size_t>(picture.width)));
        };
        const auto has = [&](const char* name) { return channels.findChannel(name) != nullptr; };
        const bool coloured = has("R") && has("G") && has("B");
        if (!coloured && !has("Y")) {
            throw InputError(file, fmt::format("is an EXR without R, G, B or Y channels; it has {}",
                                               names_of(channels)));
        }
        picture.rgb.resize(3 * pixels);
        if (coloured) {
            slice("R", picture.rgb.data(), 3);
            slice("G", picture.rgb.data() + 1, 3);
            slice("B", picture.rgb.data() + 2, 3);
        } else {
            slice("Y", picture.rgb.data(), 3);
        }
        had_alpha = has("A");
        if (had_alpha) {
            picture.coverage.resize(pixels);
            slice("A", picture.coverage.data(), 1);
        }
        // Channels come sorted by name, wavelengths are wanted by number.
        std::map<double, std::string> spectral;
        for (auto c = channels.begin(); c != channels.end(); ++c) {
            if (const auto nm = wavelength_of(c.name())) spectral.emplace(*nm, c.name());
        }
        for (const auto& [nm, name] : spectral) {
            picture.wavelengths_nm.push_back(nm);
            picture.spectral.emplace_back(pixels);
            slice(name, picture.spectral.back().data(), 1);
        }
        std::vector<std::string> further{"saturated"};
        further.insert(further.begin(), k_variance_channels.begin(), k_variance_channels.end());
        further.insert(further.end(), k_band_channels.begin(), k_band_channels.end());
        for (const std::string& name : further) {
            if (has(name.c_str())) picture.planes.push_back({name, std::vector<float>(pixels)});
        }
        for (Picture::Plane& plane : picture.planes) slice(plane.channel, plane.values.data(), 1);
        const Imf::Header& header = input.header();
        for (auto a = header.begin(); a != header.end(); ++a) {
            const std::string key = a.name();
            const auto* value = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
            if (key.starts_with("culet:") && value != nullptr)
                picture.text.emplace_back(key, value->value());
        }
        input.setFrameBuffer(frame);
        input.readPixels(window.min.y, window.max.y);
        if (!coloured) {
            for (std::size_t i = 0; i < pixels; ++i)
                picture.rgb[3 * i + 1] = picture.rgb[3 * i + 2] = picture.rgb[3 * i];
        }
        return picture;
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(file,
                         fmt::format("is no EXR that can be read: {}", one_line(error.what())));
    }
}

}  // namespace culet
