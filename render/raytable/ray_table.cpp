#include "render/raytable/ray_table.h"

#include <fmt/format.h>

#include <bit>
#include <boost/crc.hpp>
#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> k_magic{'c', 'u', 'l', 'e', 't', 'r', 'a', 'y'};
constexpr std::uint32_t k_version = 1;
constexpr std::size_t k_alignment = 64, k_unchecked = 16;  // magic, version and checksum
constexpr std::uint32_t k_most_bands = 1000, k_most_facets = 65535;
constexpr std::uint64_t k_most = 0xffffffffu;

template <class Parts, class Visit>
void each_list(const RayTableHeader& h, Parts& parts, Visit&& visit) {
    visit(parts.wavelengths_nm, h.wavelengths);
    visit(parts.frames, h.facets);
    visit(parts.hit_ray, h.hits);
    visit(parts.hit_distance, h.hits);
    visit(parts.exits_end, h.bands * h.hits);
    visit(parts.weight, h.exits);
    for (auto& list : parts.direction) visit(list, h.exits);
    for (auto& list : parts.point) visit(list, h.exits);
    visit(parts.facet, h.exits);
    for (std::uint32_t k = 0; k < h.lengths; ++k) visit(parts.length[k], h.exits);
}

std::uint64_t aligned(std::uint64_t bytes) {
    return (bytes + k_alignment - 1) / k_alignment * k_alignment;
}

std::uint32_t checksum_of(std::span<const std::byte> bytes) {
    boost::crc_32_type crc;
    crc.process_bytes(bytes.data() + k_unchecked, bytes.size() - k_unchecked);
    return crc.checksum();
}

// Checks the header, after which no size can overflow.
bool sane(const RayTableHeader& h) {
    const auto within = [](std::uint64_t v, std::uint64_t most) { return v >= 1 && v <= most; };
    return within(h.width, 65535) && within(h.height, 65535) && within(h.samples, 65535) &&
           static_cast<std::uint64_t>(h.width) * h.height * h.samples <= k_most &&
           within(h.bands, k_most_bands) && within(h.facets, k_most_facets) &&
           (h.lengths == 1 || h.lengths == 3) &&
           (h.wavelengths == h.bands || (h.wavelengths == 0 && h.bands == 1)) && h.hits <= k_most &&
           h.exits <= k_most && h.branches <= 1 && std::isfinite(h.length_step) &&
           h.length_step >= 0 && std::isfinite(h.remainder) && std::isfinite(h.cut);
}

// What is wrong with the lists' values; empty if nothing.
std::string fault_in(const RayTableHeader& h, const RayTableParts<TableSpan>& parts) {
    for (const double nm : parts.wavelengths_nm) {
        if (!(nm >= 200 && nm <= 2500)) return "a wavelength";
    }
    for (std::size_t i = 1; i < parts.wavelengths_nm.size(); ++i) {
        if (!(parts.wavelengths_nm[i] > parts.wavelengths_nm[i - 1])) return "a wavelength";
    }
    for (const FacetFrame& frame : parts.frames) {
        for (const auto* vector : {&frame.corner, &frame.u, &frame.v}) {
            for (const double x : *vector) {
                if (!std::isfinite(x)) return "a facet's frame";
            }
        }
    }
    const std::uint64_t rays = static_cast<std::uint64_t>(h.width) * h.height * h.samples;
    std::int64_t before = -1;
    for (const std::uint32_t ray : parts.hit_ray) {
        if (ray >= rays || ray <= before) return "a ray's number";
        before = ray;
    }
    for (const float distance : parts.hit_distance) {
        if (!(distance >= 0) || !std::isfinite(distance)) return "a ray's length";
    }
    std::uint32_t end = 0;
    for (const std::uint32_t next : parts.exits_end) {
        if (next < end || next > h.exits) return "a ray's exits";
        end = next;
    }
    if (end != h.exits) return "the number of exits";
    for (const float weight : parts.weight) {
        if (!(weight >= 0) || !std::isfinite(weight)) return "a weight";
    }
    for (const std::uint16_t facet : parts.facet) {
        if (facet >= h.facets) return "an exit's facet";
    }
    return {};
}

struct Mapping {
    boost::interprocess::file_mapping file;
    boost::interprocess::mapped_region region;
};

}  // namespace

RayTable::RayTable(std::span<const std::byte> bytes, std::shared_ptr<const void> kept)
    : kept_(std::move(kept)), bytes_(bytes) {
    std::memcpy(&header_, bytes_.data(), sizeof header_);
    std::uint64_t at = sizeof header_;
    each_list(header_, parts_, [&]<class T>(std::span<const T>& list, std::uint64_t count) {
        at = aligned(at);
        list = {reinterpret_cast<const T*>(bytes_.data() + at), count};
        at += count * sizeof(T);
    });
}

RayTable::RayTable(RayTableHeader header, const RayTableParts<TableVector>& parts) {
    header.magic = k_magic;
    header.version = k_version;
    header.wavelengths = static_cast<std::uint32_t>(parts.wavelengths_nm.size());
    header.facets = static_cast<std::uint32_t>(parts.frames.size());
    header.hits = parts.hit_ray.size();
    header.exits = parts.weight.size();
    check(sane(header), "a ray table's header is out of range");
    std::uint64_t size = sizeof header;
    each_list(header, parts, [&]<class T>(const std::vector<T>& list, std::uint64_t count) {
        check(list.size() == count, "a ray table's lists are not as long as they should be");
        size = aligned(size) + count * sizeof(T);
    });
    header.file_bytes = size;
    auto memory = std::make_shared<std::vector<std::byte>>(size);
    std::uint64_t at = sizeof header;
    each_list(header, parts, [&]<class T>(const std::vector<T>& list, std::uint64_t count) {
        at = aligned(at);
        if (count > 0) std::memcpy(memory->data() + at, list.data(), count * sizeof(T));
        at += count * sizeof(T);
    });
    std::memcpy(memory->data(), &header, sizeof header);
    header.checksum = checksum_of(*memory);
    std::memcpy(memory->data(), &header, sizeof header);
    *this = RayTable(*memory, memory);
    check(fault_in(header_, parts_).empty(), "a ray table's lists are out of range");
}

RayTable RayTable::open(const fs::path& file) {
    std::error_code error;
    if (fs::is_directory(file, error)) throw InputError(file, "is a folder, not a ray table");
    const std::uintmax_t size = fs::file_size(file, error);
    if (error) throw InputError(file, fmt::format("cannot be read: {}", error.message()));
    const auto damaged = [&file](const std::string& what) {
        return InputError(
            file,
            fmt::format("is a damaged ray table ({}): delete it to have it made again", what));
    };
    std::shared_ptr<Mapping> mapping = std::make_shared<Mapping>();
    RayTableHeader header;
    if (size >= k_magic.size()) {
        namespace ipc = boost::interprocess;
        try {
            mapping->file = ipc::file_mapping(file.c_str(), ipc::read_only);
            mapping->region = ipc::mapped_region(mapping->file, ipc::read_only);
        } catch (const ipc::interprocess_exception& failure) {
            throw InputError(file, fmt::format("cannot be read: {}", failure.what()));
        }
    }
    const auto* data = static_cast<const std::byte*>(mapping->region.get_address());
    if (size < k_magic.size() || std::memcmp(data, k_magic.data(), k_magic.size()) != 0)
        throw InputError(file, "is not a ray table: --table takes what --table wrote");
    if (size < sizeof header) throw damaged("it is cut off");
    std::memcpy(&header, data, sizeof header);
    if (header.version != k_version) {
        throw InputError(file, fmt::format("is a ray table of version {}, and this program reads "
                                           "version {}: delete it to have it made again",
                                           header.version, k_version));
    }
    const std::span<const std::byte> bytes(data, size);
    if (header.file_bytes > size) throw damaged("it is cut off");
    if (header.file_bytes < size) throw damaged("bytes follow its end");
    if (checksum_of(bytes) != header.checksum) throw damaged("its checksum does not fit");
    if (!sane(header)) throw damaged("its header is out of range");
    std::uint64_t end = sizeof header;
    RayTableParts<TableSpan> none;
    each_list(header, none, [&]<class T>(std::span<const T>&, std::uint64_t count) {
        end = aligned(end) + count * sizeof(T);
    });
    if (end != size) throw damaged("its lists do not fill it");
    RayTable table(bytes, mapping);
    if (const std::string fault = fault_in(table.header_, table.parts_); !fault.empty())
        throw damaged(fault + " is out of range");
    return table;
}

void RayTable::write(const fs::path& file) const {
    write_text(file, {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()});
}

}  // namespace culet
