#include "render/image/exr_file.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <stdexcept>

#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr long long k_most_exr_pixels = 1LL << 28;
constexpr long long k_most_samples = 1LL << 31;  // over all channels
constexpr long long k_tightest_exr = 20000;      // pixels per byte
constexpr unsigned k_most_tile_side = 8192;

// Checks stated sizes before the library allocates: a hostile header's pictures, tiles and offset
// tables would take gigabytes.
std::array<long long, 2> check_window(const Imath::Box2i& window, std::size_t bytes,
                                      const std::filesystem::path& file) {
    const long long width = static_cast<long long>(window.max.x) - window.min.x + 1;
    const long long height = static_cast<long long>(window.max.y) - window.min.y + 1;
    if (width < 1 || height < 1 || width > k_most_exr_pixels || height > k_most_exr_pixels ||
        width * height > k_most_exr_pixels) {
        throw InputError(file, fmt::format("is an EXR of {} x {} pixels; up to 2^28 pixels are "
                                           "read",
                                           width, height));
    }
    // No codec packs this tightly: the file is cut off.
    if (width * height / k_tightest_exr > static_cast<long long>(bytes)) {
        throw InputError(file, fmt::format("is an EXR of {} x {} pixels in {} bytes: it is cut off",
                                           width, height, bytes));
    }
    return {width, height};
}

void check_header(const Imf::Header& header, std::size_t bytes, const std::filesystem::path& file) {
    check_window(header.displayWindow(), bytes, file);
    const auto [width, height] = check_window(header.dataWindow(), bytes, file);
    long long channels = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++channels;
    if (channels > k_most_samples / (width * height)) {
        throw InputError(file, fmt::format("is an EXR of {} x {} pixels with {} channels, more "
                                           "than are read",
                                           width, height, channels));
    }
    if (header.hasTileDescription() && (header.tileDescription().xSize > k_most_tile_side ||
                                        header.tileDescription().ySize > k_most_tile_side)) {
        throw InputError(
            file, fmt::format("is an EXR with tiles of {} x {} pixels, more than are "
                              "read",
                              header.tileDescription().xSize, header.tileDescription().ySize));
    }
}

// The library allocates what an attribute claims before reading it, so check the claims of all
// headers first (OpenEXR file layout: name, type, size, value; an empty name ends a header; in a
// multi-part file an empty header ends them).
void check_attributes(const std::string& bytes, const std::filesystem::path& file) {
    constexpr unsigned k_multi_part = 0x10, k_deep = 0x08;  // bits 12 and 11 of the version field
    const InputError cut_off(file, "is an EXR whose header is cut off");
    if (bytes.size() < 9) throw cut_off;
    const auto flags = static_cast<unsigned char>(bytes[5]);
    if ((flags & k_deep) != 0)
        throw InputError(file, "is a deep EXR, which is not read here: flatten it");
    std::size_t at = 8;
    int parts = 0;
    for (;;) {
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
        if ((flags & k_multi_part) == 0) return;
        if (at == start + 1) break;
        ++parts;
    }
    if (parts != 1)
        throw InputError(file, fmt::format("is an EXR of {} parts, of which none is preferred: "
                                           "save the one you want by itself",
                                           parts));
}

}  // namespace

bool ExrStream::read(char c[], int n) {
    // Compare without adding: a broken offset table may give a place near 2^64, which would wrap.
    if (n < 0 || at_ > bytes_.size() || static_cast<std::uint64_t>(n) > bytes_.size() - at_) {
        throw std::runtime_error("the file ends too early");
    }
    std::memcpy(c, bytes_.data() + at_, static_cast<std::size_t>(n));
    at_ += static_cast<std::uint64_t>(n);
    return at_ < bytes_.size();
}

ExrWindow size_of(const Imath::Box2i& window) {
    return {window.max.x - window.min.x + 1, window.max.y - window.min.y + 1};
}

void check_exr(const std::string& bytes, const std::filesystem::path& file) {
    check_attributes(bytes, file);
    ExrStream stream(bytes, file.c_str());
    Imf::Header header;
    int version = 0;
    char magic[4];
    stream.read(magic, 4);
    stream.read(magic, 4);
    for (int i = 3; i >= 0; --i) version = version << 8 | static_cast<unsigned char>(magic[i]);
    header.readFrom(stream, version);
    check_header(header, bytes.size(), file);
}

}  // namespace culet
