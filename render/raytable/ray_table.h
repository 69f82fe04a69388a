#pragma once
// A ray table (Lee, Interactive refractive rendering for gemstones, 2004, chapter 5): for one view
// of a stone, where the light paths behind each pixel leave it, in which direction and with which
// weight. Pictures in any light follow without tracing. docs/ray-tables.md describes the file,
// which is this table byte by byte.
//
// A "hit" is an eye ray that meets the stone; an "exit" is the end of one of its light
// paths. A "band" is a set of wavelengths that share their paths; each has its own exits.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace culet {

/// 32 hexadecimal digits of a Fingerprint.
using TableKey = std::array<char, 32>;

struct RayTableHeader {
    std::array<char, 8> magic{};
    std::uint32_t version = 0;
    std::uint32_t checksum = 0;  ///< CRC-32 of all bytes behind it
    std::uint64_t file_bytes = 0;
    std::uint32_t width = 0, height = 0;  ///< pixels
    std::uint32_t samples = 1;            ///< rays per pixel
    std::uint32_t bands = 1;
    std::uint32_t facets = 0;
    std::uint32_t lengths = 1;      ///< per exit event: 1, or one per axis of a crystal
    std::uint32_t wavelengths = 0;  ///< as many as bands; 0: any, they share all paths
    std::uint32_t depth = 0;        ///< limit of the paths
    std::uint32_t deepest = 0;      ///< faces on the longest path
    std::uint32_t branches = 0;     ///< 1: paths are trees; 0: exit event k of a ray has k
                                    ///< reflections
    std::uint64_t hits = 0, exits = 0;
    double length_step = 0;         ///< one step of path length, in the stone's unit
    double remainder = 0, cut = 0;  ///< weight not in any exit event, mean over hits and bands
    TableKey stone{}, optics{}, view{}, rays{};
    std::array<char, 24> reserved{};
};
static_assert(sizeof(RayTableHeader) == 256);

/// Coordinates of exit events on a facet: point = corner + s u + t v with s, t in 0..1.
struct FacetFrame {
    std::array<double, 3> corner{}, u{}, v{};
};
static_assert(sizeof(FacetFrame) == 72);

/// Contents of a table, in the order of the file. Of each exit event: weight in a clear stone;
/// direction (octahedral_codes.h); point in the facet's frame in steps of 1/65535; path length
/// inside the stone in steps of `length_step`.
template <template <class> class List>
struct RayTableParts {
    List<double> wavelengths_nm;
    List<FacetFrame> frames;        ///< per facet
    List<std::uint32_t> hit_ray;    ///< per hit: pixel x samples + sample; increasing
    List<float> hit_distance;       ///< from the eye to the stone
    List<std::uint32_t> exits_end;  ///< at band x hits + hit: the index after its last exit event
    List<float> weight;             ///< per exit event
    std::array<List<std::int32_t>, 2> direction;
    std::array<List<std::uint16_t>, 2> point;
    List<std::uint16_t> facet;
    std::array<List<std::uint16_t>, 3> length;
};

template <class T>
using TableSpan = std::span<const T>;
template <class T>
using TableVector = std::vector<T>;

class RayTable {
public:
    /// Maps a file and checks all of it. Throws InputError in one line if it is missing, truncated,
    /// damaged, of another version, or no ray table.
    static RayTable open(const std::filesystem::path& file);
    /// Fills in the counts, bytes and checksum of `header`. Throws InternalError if the parts do
    /// not fit together.
    RayTable(RayTableHeader header, const RayTableParts<TableVector>& parts);

    /// Writes the whole file or nothing. Throws InputError if it cannot be written.
    void write(const std::filesystem::path& file) const;

    const RayTableHeader& header() const { return header_; }
    const RayTableParts<TableSpan>& parts() const { return parts_; }
    std::size_t bytes() const { return bytes_.size(); }

private:
    explicit RayTable(std::span<const std::byte> bytes, std::shared_ptr<const void> kept);

    std::shared_ptr<const void> kept_;  // the mapping or the memory
    std::span<const std::byte> bytes_;
    RayTableHeader header_;
    RayTableParts<TableSpan> parts_;
};

/// Bytes of one exit event in the file.
constexpr std::size_t exit_bytes(unsigned lengths) {
    return 4 + 2 * 4 + 2 * 2 + 2 + 2 * static_cast<std::size_t>(lengths);
}

}  // namespace culet
