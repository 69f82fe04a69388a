#include "render/image_exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "stone/errors.h"

namespace culet {

namespace {

constexpr long long k_most_pixels = 1LL << 28;

// The library reads from files or from a stream of ours; bytes in memory are checked before they
// are read.
class MemoryStream : public Imf::IStream {
public:
    MemoryStream(const std::string& bytes, const char* name) : Imf::IStream(name), bytes_(bytes) {}
    bool read(char c[], int n) override {
        if (n < 0 || at_ + static_cast<std::uint64_t>(n) > bytes_.size()) {
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

std::string one_line(const char* what) {
    std::string text(what);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

}  // namespace

Picture read_exr(const std::string& bytes, const std::filesystem::path& file, bool& had_alpha) {
    try {
        MemoryStream stream(bytes, file.c_str());
        Imf::InputFile input(stream, 0);
        const Imath::Box2i window = input.header().dataWindow();
        const long long width = static_cast<long long>(window.max.x) - window.min.x + 1;
        const long long height = static_cast<long long>(window.max.y) - window.min.y + 1;
        if (width < 1 || height < 1 || width > k_most_pixels || height > k_most_pixels ||
            width * height > k_most_pixels) {
            throw InputError(
                file, fmt::format("is an EXR of {} x {} pixels; up to 2^28 pixels are read", width,
                                  height));
        }
        // No codec packs a picture this tightly: the file is cut off, and nothing is allocated for
        // it.
        constexpr long long k_tightest = 20000;  // pixels a byte
        if (width * height / k_tightest > static_cast<long long>(bytes.size())) {
            throw InputError(
                file, fmt::format("is an EXR of {} x {} pixels in {} bytes: it is cut off", width,
                                  height, bytes.size()));
        }
        const Imf::ChannelList& channels = input.header().channels();
        std::vector<std::string> names{"R", "G", "B"};
        if (channels.findChannel("R") == nullptr || channels.findChannel("G") == nullptr ||
            channels.findChannel("B") == nullptr) {
            if (channels.findChannel("Y") == nullptr) {
                throw InputError(file, "is an EXR without R, G, B or Y channels");
            }
            names = {"Y"};
        }
        Picture picture;
        picture.width = static_cast<int>(width);
        picture.height = static_cast<int>(height);
        had_alpha = channels.findChannel("A") != nullptr;
        const std::size_t pixels = picture.pixels();
        std::vector<std::vector<float>> planes(names.size() + 1);
        Imf::FrameBuffer frame;
        const auto slice = [&](const std::string& name, std::vector<float>& plane) {
            plane.resize(pixels);
            char* base = reinterpret_cast<char*>(plane.data()) -
                         (static_cast<std::ptrdiff_t>(window.min.y) * width + window.min.x) *
                             static_cast<std::ptrdiff_t>(sizeof(float));
            const Imf::Channel* channel = channels.findChannel(name.c_str());
            if (channel->xSampling != 1 || channel->ySampling != 1) {
                throw InputError(file,
                                 "is an EXR with subsampled channels, which are not read here");
            }
            frame.insert(name, Imf::Slice(Imf::FLOAT, base, sizeof(float),
                                          sizeof(float) * static_cast<std::size_t>(width)));
        };
        for (std::size_t i = 0; i < names.size(); ++i) slice(names[i], planes[i]);
        if (had_alpha) slice("A", planes.back());
        input.setFrameBuffer(frame);
        input.readPixels(window.min.y, window.max.y);
        picture.rgb.resize(3 * pixels);
        for (std::size_t i = 0; i < pixels; ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                picture.rgb[3 * i + c] = planes[names.size() == 3 ? c : 0][i];
        }
        if (had_alpha) picture.coverage = std::move(planes.back());
        return picture;
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(file,
                         fmt::format("is no EXR that can be read: {}", one_line(error.what())));
    }
}

void write_exr(const Picture& picture, const std::filesystem::path& file,
               const std::vector<std::pair<std::string, std::string>>& text) {
    try {
        Imf::Header header(picture.width, picture.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const auto& [key, value] : text) header.insert(key, Imf::StringAttribute(value));
        const std::size_t pixels = picture.pixels();
        std::array<std::vector<float>, 3> planes;
        for (std::size_t c = 0; c < 3; ++c) {
            planes[c].resize(pixels);
            for (std::size_t i = 0; i < pixels; ++i) planes[c][i] = picture.rgb[3 * i + c];
        }
        Imf::FrameBuffer frame;
        const auto slice = [&](const std::string& name, const std::vector<float>& plane) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame.insert(
                name,
                Imf::Slice(Imf::FLOAT,
                           const_cast<char*>(reinterpret_cast<const char*>(plane.data())),
                           sizeof(float), sizeof(float) * static_cast<std::size_t>(picture.width)));
        };
        slice("R", planes[0]);
        slice("G", planes[1]);
        slice("B", planes[2]);
        if (!picture.coverage.empty()) slice("A", picture.coverage);
        if (!picture.spectral.empty())
            header.insert("spectralLayoutVersion", Imf::StringAttribute("1.0"));
        for (std::size_t i = 0; i < picture.spectral.size(); ++i) {
            // The layout writes the decimal point as a comma: a point would start a layer.
            std::string nm = fmt::format("{:.6g}", picture.wavelengths_nm[i]);
            std::replace(nm.begin(), nm.end(), '.', ',');
            if (nm.find(',') == std::string::npos) nm += ",0";
            slice("S0." + nm + "nm", picture.spectral[i]);
        }
        Imf::OutputFile output(file.c_str(), header, 0);
        output.setFrameBuffer(frame);
        output.writePixels(picture.height);
    } catch (const std::exception& error) {
        throw InputError(file, fmt::format("cannot be written: {}", one_line(error.what())));
    }
}

}  // namespace culet
