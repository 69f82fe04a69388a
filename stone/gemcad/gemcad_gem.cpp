// GemCad .gem: little-endian records of facets, then a trailer.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>

#include "stone/gemcad/cut_planes.h"
#include "stone/text/errors.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

class GemParser {
public:
    GemParser(std::string_view bytes, const std::filesystem::path& file)
        : bytes_(bytes), file_(file) {}

    void parse() {
        constexpr double end_of_facets = -99999.0;
        for (double first = number(); first != end_of_facets; first = number()) {
            read_facet(first);
        }
        read_trailer();
        settle_tiers();
    }

    ReadCut cut;  // collects the notes
    Design design;
    std::vector<CutPlane> planes;

private:
    std::string_view take(std::size_t count) {
        if (bytes_.size() - at_ < count) {
            throw InputError(file_, fmt::format("ends at byte {} in the middle of {}: it is cut "
                                                "short, or not a GemCad .gem file",
                                                bytes_.size(), where_));
        }
        const std::string_view taken = bytes_.substr(at_, count);
        at_ += count;
        return taken;
    }

    std::uint64_t little_endian(std::size_t size) {
        std::uint64_t word = 0;
        const std::string_view raw = take(size);
        for (std::size_t i = 0; i < size; ++i) {
            word |= static_cast<std::uint64_t>(static_cast<unsigned char>(raw[i])) << (8 * i);
        }
        return word;
    }

    double number() { return std::bit_cast<double>(little_endian(8)); }
    std::int32_t integer() {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(little_endian(4)));
    }
    std::string_view text() { return take(little_endian(1)); }

    void read_facet(double x) {
        where_ = fmt::format("facet {}", planes.size());
        // The unit normal divided by the plane's distance.
        const double y = number(), z = number();
        const double length = std::hypot(x, y, z);
        if (!std::isfinite(length) || !(length > 0) || !std::isfinite(1 / length)) {
            throw InputError(file_, fmt::format("the plane of {} is not a plane: this is not a "
                                                "GemCad .gem file, or it is damaged",
                                                where_));
        }
        const std::int32_t tier = integer();
        const std::string_view label = text();
        CutPlane plane;
        plane.plane = {Vec3(x, y, z) / length, 1 / length};
        const std::size_t tab = std::min(label.find('\t'), label.size());
        plane.name = utf8_from_windows1252(label.substr(0, tab));
        plane.place = fmt::format("facet {} (tier {})", planes.size(), tier);
        const auto [known, is_new] = tiers_.try_emplace(tier, int(design.tiers.size()));
        if (is_new) design.tiers.emplace_back();
        DesignTier& own = design.tiers[std::size_t(known->second)];
        plane.tier = known->second;
        plane.facet = static_cast<int>(own.facets.size());
        own.facets.push_back({0, plane.name, {}});
        if (own.instruction.empty())
            own.instruction = utf8_from_windows1252(trimmed(label.substr(tab)));
        planes.push_back(std::move(plane));
        // Skip the corners: the meets are computed from the planes.
        while (integer() == 1) take(3 * 8);
    }

    void read_trailer() {
        where_ = "the trailer";
        const std::int32_t order = integer();
        design.symmetry = order >= 1 ? order : 1;
        design.mirror = integer() != 0;
        const std::int32_t gear = integer();
        if (gear == 0) {
            cut.notes.push_back("the file gives a gear of 0 teeth: 96 are assumed");
        } else {
            design.gear = gear;
        }
        const double refractive_index = number();
        if (refractive_index >= 1 && refractive_index < 10) {
            design.refractive_index = refractive_index;
        }
        integer();  // 32767 in all files that we know
        const double offset = number();
        if (std::isfinite(offset) && std::abs(offset) <= 1e6) design.gear_offset = offset;
        for (int i = 0; i < 8; ++i) {
            (i < 4 ? design.headings : design.footnotes).push_back(utf8_from_windows1252(text()));
        }
        for (std::vector<std::string>* lines : {&design.headings, &design.footnotes}) {
            while (!lines->empty() && lines->back().empty()) lines->pop_back();
        }
    }

    /// Call it once the gear is known. Removes the planes' rounding error.
    void settle_tiers() {
        for (const CutPlane& plane : planes) {
            CutSetting setting = setting_of(plane.plane, design);
            setting.angle_deg = without_noise(setting.angle_deg);
            DesignTier& tier = design.tiers[std::size_t(plane.tier)];
            tier.facets[std::size_t(plane.facet)].index = without_noise(setting.index);
            if (plane.facet == 0) tier.setting = setting;
        }
    }

    std::map<int, int> tiers_;  // of the design, by their numbers in the file
    std::string_view bytes_;
    std::size_t at_ = 0;
    const std::filesystem::path& file_;
    std::string where_ = "the first facet";
};

}  // namespace

ReadCut parse_gemcad_gem(std::string_view bytes, const CutReading& how,
                         const std::filesystem::path& file) {
    if (bytes.empty()) throw InputError(file, "is empty");
    GemParser parser(bytes, file);
    parser.parse();
    build_solid(parser.cut, std::move(parser.design), parser.planes, how, file);
    return std::move(parser.cut);
}

}  // namespace culet
