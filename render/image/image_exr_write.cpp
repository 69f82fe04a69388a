#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <list>

#include "render/image/image_exr.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// The layout uses a decimal comma, because a point would start a layer.
std::string channel_of(std::size_t stokes, double nm) {
    std::string text = fmt::format("{:.3f}", nm);
    std::replace(text.begin(), text.end(), '.', ',');
    return fmt::format("S{}.{}nm", stokes, text);
}

// Collects the channels to write.
class Channels {
public:
    explicit Channels(const Picture& picture) : picture_(picture) {}

    void add(const std::string& name, const std::vector<float>& plane) {
        insert(name, Imf::FLOAT, plane.data(), sizeof(float));
    }
    // Stored as Picture::samples says. The plane is copied.
    void add_colour(const std::string& name, std::vector<float> plane) {
        if (picture_.samples == Picture::Samples::half) {
            const auto& kept = halves_.emplace_back(plane.begin(), plane.end());
            insert(name, Imf::HALF, kept.data(), sizeof(Imath::half));
        } else {
            add(name, singles_.emplace_back(std::move(plane)));
        }
    }
    bool has(const std::string& name) const { return frame_.findSlice(name) != nullptr; }

    void write(Imf::Header& header, const std::filesystem::path& file) const {
        header.channels() = list_;
        Imf::OutputFile output(file.c_str(), header, 0);
        output.setFrameBuffer(frame_);
        output.writePixels(picture_.height);
    }

private:
    void insert(const std::string& name, Imf::PixelType type, const void* first,
                std::size_t bytes) {
        list_.insert(name, Imf::Channel(type));
        frame_.insert(name, Imf::Slice(type, static_cast<char*>(const_cast<void*>(first)), bytes,
                                       bytes * static_cast<std::size_t>(picture_.width)));
    }

    const Picture& picture_;
    Imf::ChannelList list_;
    Imf::FrameBuffer frame_;
    std::list<std::vector<float>> singles_;
    std::list<std::vector<Imath::half>> halves_;
};

std::vector<float> channel(const Picture& picture, std::size_t c) {
    std::vector<float> plane(picture.pixels());
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = picture.rgb[3 * i + c];
    return plane;
}

void add_spectral(const Picture& picture, Imf::Header& header, Channels& channels) {
    header.insert("spectralLayoutVersion", Imf::StringAttribute("1.0"));
    header.insert("emissiveUnits", Imf::StringAttribute("relative to CIE D65"));
    for (std::size_t i = 0; i < picture.spectral.size(); ++i) {
        const std::string name = channel_of(0, picture.wavelengths_nm[i]);
        if (channels.has(name)) {
            throw InputError(
                "two wavelengths are closer than 0.001 nm, which their names cannot tell");
        }
        channels.add(name, picture.spectral[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            if (!picture.polarised[k].empty())
                channels.add(channel_of(k + 1, picture.wavelengths_nm[i]), picture.polarised[k][i]);
        }
    }
    if (!picture.polarised[0].empty())
        header.insert("polarisationHandedness", Imf::StringAttribute("right"));
}

}  // namespace

void write_exr(const Picture& picture, const std::filesystem::path& file,
               const std::vector<std::pair<std::string, std::string>>& text) {
    try {
        Imf::Header header(picture.width, picture.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const auto& [key, value] : text) header.insert(key, Imf::StringAttribute(value));
        Channels channels(picture);
        channels.add_colour("R", channel(picture, 0));
        channels.add_colour("G", channel(picture, 1));
        channels.add_colour("B", channel(picture, 2));
        if (!picture.coverage.empty()) channels.add_colour("A", picture.coverage);
        if (!picture.spectral.empty()) add_spectral(picture, header, channels);
        for (const Picture::Plane& plane : picture.planes)
            channels.add(plane.channel, plane.values);
        if (!picture.standard_error.empty())
            channels.add("standard_error.Y", picture.standard_error);
        if (picture.environment == Picture::Environment::lat_long)
            Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
        if (picture.environment == Picture::Environment::cube)
            Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
        channels.write(header, file);
    } catch (const std::exception& error) {
        throw InputError(file, fmt::format("cannot be written: {}", one_line(error.what())));
    }
}

}  // namespace culet
