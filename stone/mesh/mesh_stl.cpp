// STL (3D Systems 1989): triangles without connectivity, as text or in binary single precision.

#include <fmt/format.h>

#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "stone/mesh/mesh_formats.h"
#include "stone/text/errors.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

constexpr std::size_t k_binary_header = 84, k_binary_triangle = 50;

std::uint32_t little_endian_word(std::string_view bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    }
    return word;
}

FaceSoup parse_binary(std::string_view bytes, std::size_t count,
                      const std::filesystem::path& file) {
    FaceSoup soup;
    soup.vertices.reserve(3 * count);
    soup.faces.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = k_binary_header + i * k_binary_triangle;
        Vec3 rows[4];
        for (std::size_t k = 0; k < 12; ++k) {
            const float value = std::bit_cast<float>(little_endian_word(bytes, at + 4 * k));
            rows[k / 3][static_cast<int>(k % 3)] = static_cast<double>(value);
            if (k >= 3 && !std::isfinite(value)) {
                throw InputError(
                    file,
                    fmt::format("triangle {} of {} has a coordinate that is not finite", i, count));
            }
            if (k >= 3) soup.precision.add_single(static_cast<double>(value));
        }
        SoupFace face;
        for (int k = 1; k <= 3; ++k) {
            face.corners.push_back(static_cast<int>(soup.vertices.size()));
            soup.vertices.push_back(rows[k]);
        }
        const double length = glm::length(rows[0]);
        if (std::isfinite(length) && length > 0) {
            face.given_normal = rows[0];
            for (int axis = 0; axis < 3; ++axis) soup.normal_precision.add_single(rows[0][axis]);
        }
        soup.faces.push_back(std::move(face));
    }
    return soup;
}

class AsciiStlParser {
public:
    AsciiStlParser(std::string_view text, const std::filesystem::path& file)
        : lines_(text), file_(file) {}

    // Ignores line breaks and case, since writers differ in both and in `endloop` and `end loop`. A
    // solid's name is the rest of its line and is skipped, like lines that begin with `;` or `#`.
    FaceSoup parse() {
        while (next_word()) {
            if (is("solid") || is("endsolid")) {
                words_.clear();
                at_ = 0;
            } else if (is("facet")) {
                read_facet();
            } else {
                fail("facet, endsolid or solid");
            }
        }
        return std::move(soup_);
    }

private:
    bool next_word() {
        while (at_ >= words_.size()) {
            const auto line = lines_.next();
            if (!line) return false;
            words_ = words_of(*line);
            if (!words_.empty() && (words_[0][0] == ';' || words_[0][0] == '#')) words_.clear();
            at_ = 0;
        }
        word_ = words_[at_++];
        if (is("end") && at_ < words_.size()) {
            end_of_ = "end" + std::string(words_[at_++]);
            word_ = end_of_;
        }
        return true;
    }

    bool is(std::string_view keyword) const { return lower_case(std::string(word_)) == keyword; }

    [[noreturn]] void fail(std::string_view expected) const {
        throw InputError(file_, lines_.line(),
                         fmt::format("expected {}, found '{}'", expected, shown(word_)));
    }

    void expect(std::string_view keyword) {
        if (!next_word()) {
            throw InputError(
                file_, lines_.line() + 1,
                fmt::format("the file ends where '{}' should be: is it cut short?", keyword));
        }
        if (!is(keyword)) fail(fmt::format("'{}'", keyword));
    }

    double number(const char* of) {
        if (!next_word()) {
            throw InputError(file_, lines_.line() + 1,
                             fmt::format("the file ends within {}: is it cut short?", of));
        }
        const auto value = number_in(word_);
        if (!value)
            throw InputError(file_, lines_.line(),
                             fmt::format("{}; expected a number of {}", not_a_number(word_), of));
        return *value;
    }

    void read_facet() {
        SoupFace face;
        expect("normal");
        Vec3 normal{0, 0, 0};
        bool finite = true;
        for (int axis = 0; axis < 3; ++axis) {
            if (!next_word()) fail("three numbers of a normal");
            // Some writers put `nan` for a triangle without area.
            const auto value = number_in(word_);
            finite &= value.has_value();
            normal[axis] = value.value_or(0);
            if (value) soup_.normal_precision.add(word_, *value);
        }
        if (finite) face.given_normal = normal;
        expect("outer");
        expect("loop");
        while (next_word() && is("vertex")) {
            Vec3 vertex;
            for (int axis = 0; axis < 3; ++axis) {
                vertex[axis] = number("a vertex");
                soup_.precision.add(word_, vertex[axis]);
            }
            face.corners.push_back(static_cast<int>(soup_.vertices.size()));
            soup_.vertices.push_back(vertex);
        }
        if (!is("endloop")) fail("'vertex' or 'endloop'");
        expect("endfacet");
        if (face.corners.size() < 3) fail("at least three vertices in a loop");
        soup_.faces.push_back(std::move(face));
    }

    LineReader lines_;
    const std::filesystem::path& file_;
    std::vector<std::string_view> words_;
    std::size_t at_ = 0;
    std::string_view word_;
    std::string end_of_;  // `endloop` in `end loop`
    FaceSoup soup_;
};

/// Decided by content: many binary files begin with the word `solid` too, and many text files do
/// not.
bool looks_like_text(std::string_view bytes) {
    if (is_utf16(bytes)) return true;
    const std::string start = lower_case(std::string(trimmed(bytes.substr(0, 1024))));
    return start.find('\0') == std::string::npos &&
           (start.starts_with("solid") || start.find("facet") != std::string::npos);
}

bool is_binary(std::string_view bytes) {
    return bytes.size() >= k_binary_header &&
           bytes.size() ==
               k_binary_header + std::size_t{little_endian_word(bytes, 80)} * k_binary_triangle;
}

}  // namespace

FaceSoup parse_stl(std::string_view bytes, const std::filesystem::path& file) {
    // Some programs write a UTF-8 byte order mark before the header.
    if (bytes.starts_with(k_utf8_mark) && is_binary(bytes.substr(k_utf8_mark.size())))
        bytes.remove_prefix(k_utf8_mark.size());
    const std::size_t count =
        bytes.size() >= k_binary_header ? little_endian_word(bytes, 80) : std::size_t{0};
    const std::size_t size = k_binary_header + count * k_binary_triangle;
    FaceSoup soup;
    if (is_binary(bytes)) {
        soup = parse_binary(bytes, count, file);
    } else if (looks_like_text(bytes)) {
        const std::string text = decoded_text(bytes, file);
        soup = AsciiStlParser(text, file).parse();
    } else if (const std::string other = foreign_kind(bytes); !other.empty()) {
        throw InputError(file, other);
    } else if (bytes.size() < k_binary_header) {
        throw InputError(file,
                         "is not STL: neither text that begins with 'solid' nor long enough for a "
                         "binary header");
    } else if (bytes.size() < size) {
        throw InputError(file, fmt::format("promises {} triangles ({} bytes) but has {} bytes: is "
                                           "it cut short, or not STL at all?",
                                           count, size, bytes.size()));
    } else {
        soup = parse_binary(bytes, count, file);
        soup.notes.push_back(
            fmt::format("{} bytes after the last triangle were passed over", bytes.size() - size));
    }
    if (soup.faces.empty()) throw InputError(file, "holds no triangles");
    return soup;
}

std::string stl_text(const Solid& solid) {
    // Normals have all digits, so that readers can tell which triangles form one facet.
    std::string text = "solid culet\n";
    for (const Facet& facet : solid.facets) {
        const Vec3& n = facet.plane.normal;
        for (std::size_t i = 1; i + 1 < facet.corners.size(); ++i) {
            text +=
                fmt::format("facet normal {:.16e} {:.16e} {:.16e}\n outer loop\n", n.x, n.y, n.z);
            for (const std::size_t k : {std::size_t{0}, i, i + 1}) {
                const Vec3& v = solid.vertices[facet.corners[k]];
                text += fmt::format("  vertex {:.16e} {:.16e} {:.16e}\n", v.x, v.y, v.z);
            }
            text += " endloop\nendfacet\n";
        }
    }
    return text + "endsolid culet\n";
}

}  // namespace culet
