// PLY (Turk 1994): a text header that declares elements and their properties, then the elements as
// text or in binary of either byte order. Vertices need x, y, z. Faces need a list vertex_indices
// (or vertex_index); so do triangle strips (element tristrips, as in Stanford's scans; -1 ends a
// strip). Everything else is skipped.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "stone/mesh/mesh_formats.h"
#include "stone/text/errors.h"
#include "stone/text/text_decoding.h"

namespace culet {

namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Form { text, little_endian, big_endian };

constexpr std::size_t size_of(Scalar type) {
    switch (type) {
        case Scalar::int8:
        case Scalar::uint8:
            return 1;
        case Scalar::int16:
        case Scalar::uint16:
            return 2;
        case Scalar::int32:
        case Scalar::uint32:
        case Scalar::float32:
            return 4;
        case Scalar::float64:
            return 8;
    }
    return 8;
}

std::optional<Scalar> scalar_named(std::string_view name) {
    if (name == "char" || name == "int8") return Scalar::int8;
    if (name == "uchar" || name == "uint8") return Scalar::uint8;
    if (name == "short" || name == "int16") return Scalar::int16;
    if (name == "ushort" || name == "uint16") return Scalar::uint16;
    if (name == "int" || name == "int32") return Scalar::int32;
    if (name == "uint" || name == "uint32") return Scalar::uint32;
    if (name == "float" || name == "float32") return Scalar::float32;
    if (name == "double" || name == "float64") return Scalar::float64;
    return std::nullopt;
}

struct Property {
    std::string name;
    Scalar type = Scalar::float32;
    std::optional<Scalar> count_type;  ///< set for a list
};

struct Element {
    std::string name;
    std::int64_t count = 0;
    std::vector<Property> properties;
};

class PlyParser {
public:
    PlyParser(std::string_view bytes, const std::filesystem::path& file)
        : bytes_(bytes), lines_(bytes), file_(file) {}

    FaceSoup parse() {
        read_header();
        position_ = std::min(lines_.position(), bytes_.size());
        // If lines end in CR alone, a LF after the last CR is the first byte of the data.
        if (ends_in_cr_ && bytes_[position_ - 1] == '\n') --position_;
        bool has_vertices = false, has_faces = false;
        for (const Element& element : elements_) {
            check_room(element);
            // An element without properties takes no room, whatever its count.
            if (element.properties.empty()) continue;
            has_vertices |= element.name == "vertex";
            has_faces |= element.name == "face" || element.name == "tristrips";
            read_element(element);
        }
        if (!has_vertices || !has_faces || soup_.vertices.empty() || soup_.faces.empty()) {
            throw InputError(file_,
                             "holds no mesh: it needs elements vertex and face (or tristrips)");
        }
        for (std::size_t f = 0; f < soup_.faces.size(); ++f) {
            for (const int corner : soup_.faces[f].corners) {
                if (corner >= 0 && corner < static_cast<int>(soup_.vertices.size())) continue;
                throw InputError(file_, fmt::format("face {} uses vertex {}, but they count from 0 "
                                                    "to {}",
                                                    f, corner, soup_.vertices.size() - 1));
            }
        }
        return std::move(soup_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(file_, lines_.line(), what);
    }

    void read_header() {
        const auto magic = lines_.next();
        if (!magic || trimmed(*magic) != "ply") fail("a PLY file begins with the line ply");
        ends_in_cr_ = bytes_.substr(magic->size()).starts_with('\r') &&
                      !bytes_.substr(magic->size()).starts_with("\r\n");
        bool has_format = false;
        while (const auto line = lines_.next()) {
            const std::vector<std::string_view> words = words_of(*line);
            if (words.empty()) continue;
            if (words[0] == "comment" || words[0] == "obj_info") {
                read_comment(soup_, trimmed(*line).substr(words[0].size()));
            } else if (words[0] == "format" && words.size() >= 2) {
                has_format = true;
                if (words[1] == "ascii") {
                    form_ = Form::text;
                } else if (words[1] == "binary_little_endian") {
                    form_ = Form::little_endian;
                } else if (words[1] == "binary_big_endian") {
                    form_ = Form::big_endian;
                } else {
                    fail(
                        fmt::format("'{}' is not a PLY format: ascii, binary_little_endian or "
                                    "binary_big_endian",
                                    shown(words[1])));
                }
            } else if (words[0] == "element") {
                const auto count = words.size() == 3 ? integer_in(words[2]) : std::nullopt;
                if (!count || *count < 0) fail("expected: element NAME COUNT");
                elements_.push_back({std::string(words[1]), *count, {}});
            } else if (words[0] == "property") {
                read_property(words);
            } else if (words[0] == "end_header") {
                if (!has_format) fail("the header names no format");
                return;
            } else {
                fail(fmt::format("'{}' is not a word of a PLY header", shown(words[0])));
            }
        }
        fail("the header has no end_header");
    }

    void read_property(const std::vector<std::string_view>& words) {
        if (elements_.empty()) fail("a property stands before any element");
        const bool is_list = words.size() == 5 && words[1] == "list";
        if (!is_list && words.size() != 3) {
            fail("expected: property TYPE NAME, or property list TYPE TYPE NAME");
        }
        Property property;
        property.name = words.back();
        const std::string_view type_word = words[words.size() - 2];
        const auto type = scalar_named(type_word);
        if (!type) fail(fmt::format("'{}' is not a type of a PLY property", shown(type_word)));
        property.type = *type;
        if (is_list) {
            property.count_type = scalar_named(words[2]);
            if (!property.count_type || *property.count_type == Scalar::float32 ||
                *property.count_type == Scalar::float64) {
                fail(fmt::format("'{}' is not a type for the length of a list", shown(words[2])));
            }
        }
        elements_.back().properties.push_back(std::move(property));
    }

    // Checked before anything is stored: a file whose rest cannot hold the stated count is wrong or
    // cut short.
    void check_room(const Element& element) const {
        std::size_t least = 0;
        for (const Property& property : element.properties) {
            least += form_ == Form::text ? 2 : size_of(property.count_type.value_or(property.type));
        }
        const std::size_t left = bytes_.size() - position_ + 1;
        if (least > 0 && static_cast<std::uint64_t>(element.count) > left / least) {
            throw InputError(file_, fmt::format("promises {} elements {}, more than the file has "
                                                "room for: is it cut short?",
                                                element.count, shown(element.name)));
        }
    }

    void pass_over(Scalar type) {
        if (form_ == Form::text) {
            find_word();
        } else {
            next_scalar(type);
        }
    }

    double next_scalar(Scalar type) {
        if (form_ == Form::text) return next_word();
        const std::size_t size = size_of(type);
        if (bytes_.size() - position_ < size) {
            throw InputError(file_, fmt::format("ends in the middle of element {}: is it cut "
                                                "short?",
                                                current_));
        }
        char raw[8];
        std::memcpy(raw, bytes_.data() + position_, size);
        position_ += size;
        const bool file_is_little = form_ == Form::little_endian;
        if (file_is_little != (std::endian::native == std::endian::little)) {
            std::reverse(raw, raw + size);
        }
        switch (type) {
            case Scalar::int8:
                return as<std::int8_t>(raw);
            case Scalar::uint8:
                return as<std::uint8_t>(raw);
            case Scalar::int16:
                return as<std::int16_t>(raw);
            case Scalar::uint16:
                return as<std::uint16_t>(raw);
            case Scalar::int32:
                return as<std::int32_t>(raw);
            case Scalar::uint32:
                return as<std::uint32_t>(raw);
            case Scalar::float32:
                return static_cast<double>(as<float>(raw));
            case Scalar::float64:
                return as<double>(raw);
        }
        return 0;
    }

    template <class T>
    static T as(const char* raw) {
        T value;
        std::memcpy(&value, raw, sizeof value);
        return value;
    }

    // Sets `word_`; returns where it begins.
    std::size_t find_word() {
        constexpr std::string_view blanks = " \t\r\n\v\f";
        const std::size_t start = bytes_.find_first_not_of(blanks, position_);
        if (start == std::string_view::npos) {
            throw InputError(file_, fmt::format("ends in the middle of element {}: is it cut "
                                                "short?",
                                                current_));
        }
        const std::size_t end = std::min(bytes_.find_first_of(blanks, start), bytes_.size());
        word_ = bytes_.substr(start, end - start);
        position_ = end;
        return start;
    }

    double next_word() {
        const std::size_t start = find_word();
        const auto number = number_in(word_);
        if (!number) {
            const auto line = 1 + std::count(bytes_.begin(), bytes_.begin() + start, '\n');
            throw InputError(file_, line,
                             fmt::format("{}, in element {}", not_a_number(word_), current_));
        }
        return *number;
    }

    std::int64_t next_count(Scalar type) {
        const double count = next_scalar(type);
        const double room = static_cast<double>(bytes_.size() - position_);
        if (!(count >= 0) || count > room || count != std::floor(count)) {
            throw InputError(
                file_, fmt::format("element {}: a list cannot have {} entries", current_, count));
        }
        return static_cast<std::int64_t>(count);
    }

    // Which properties of an element are the coordinates and the corners; -1: none.
    struct Wanted {
        int axis_of[3] = {-1, -1, -1};
        int corners = -1;
    };
    Wanted wanted_of(const Element& element, bool is_vertex, bool is_face) const {
        Wanted wanted;
        for (int p = 0; p < static_cast<int>(element.properties.size()); ++p) {
            const Property& property = element.properties[p];
            if (is_vertex && !property.count_type) {
                for (int axis = 0; axis < 3; ++axis) {
                    if (property.name == std::string_view("xyz").substr(axis, 1))
                        wanted.axis_of[axis] = p;
                }
            }
            if (is_face && property.count_type &&
                (property.name == "vertex_indices" || property.name == "vertex_index")) {
                wanted.corners = p;
            }
        }
        const int* axis_of = wanted.axis_of;
        if (is_vertex && (axis_of[0] < 0 || axis_of[1] < 0 || axis_of[2] < 0)) {
            throw InputError(file_, "element vertex needs the properties x, y and z");
        }
        if (is_face && wanted.corners < 0) {
            throw InputError(file_, fmt::format("element {} needs the list property vertex_indices",
                                                element.name));
        }
        return wanted;
    }

    void read_element(const Element& element) {
        const bool is_vertex = element.name == "vertex", is_strip = element.name == "tristrips",
                   is_face = element.name == "face" || is_strip;
        const Wanted wanted = wanted_of(element, is_vertex, is_face);
        for (std::int64_t i = 0; i < element.count; ++i) {
            current_ = fmt::format("{} {} of {}", shown(element.name), i, element.count);
            Vec3 vertex{0, 0, 0};
            std::vector<double> corners;
            for (int p = 0; p < static_cast<int>(element.properties.size()); ++p) {
                const Property& property = element.properties[p];
                if (property.count_type) {
                    const std::int64_t count = next_count(*property.count_type);
                    for (std::int64_t k = 0; k < count; ++k) {
                        if (p == wanted.corners) {
                            corners.push_back(next_scalar(property.type));
                        } else {
                            pass_over(property.type);
                        }
                    }
                    continue;
                }
                const auto* axis = std::find(wanted.axis_of, wanted.axis_of + 3, p);
                if (axis == wanted.axis_of + 3) {
                    pass_over(property.type);
                } else {
                    vertex[int(axis - wanted.axis_of)] =
                        coordinate(next_scalar(property.type), property.type);
                }
            }
            if (is_vertex) soup_.vertices.push_back(vertex);
            if (is_strip) {
                add_strips(corners);
            } else if (is_face) {
                soup_.faces.emplace_back();
                for (const double corner : corners)
                    soup_.faces.back().corners.push_back(corner_at(corner));
            }
        }
    }

    // Every other triangle of a strip runs the other way.
    void add_strips(const std::vector<double>& corners) {
        std::size_t first = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (corners[i] == -1) {
                first = i + 1;
                continue;
            }
            if (i < first + 2) continue;
            int a = corner_at(corners[i - 2]), b = corner_at(corners[i - 1]);
            if ((i - first) % 2 == 1) std::swap(a, b);
            soup_.faces.emplace_back();
            soup_.faces.back().corners = {a, b, corner_at(corners[i])};
        }
    }

    int corner_at(double value) const {
        if (!(value >= 0 && value < 2147483647.0) || value != std::floor(value)) {
            throw InputError(file_, fmt::format("{}: {} is not a vertex", current_, value));
        }
        return static_cast<int>(value);
    }

    double coordinate(double value, Scalar type) {
        if (!std::isfinite(value)) {
            throw InputError(file_,
                             fmt::format("{} has a coordinate that is not finite", current_));
        }
        if (form_ == Form::text) soup_.precision.add(word_, value);
        if (type == Scalar::float32) {
            soup_.precision.add_single(value);
        } else if (form_ != Form::text) {
            soup_.precision.add_double(value);
        }
        return value;
    }

    std::string_view bytes_;
    LineReader lines_;
    const std::filesystem::path& file_;
    Form form_ = Form::text;
    std::vector<Element> elements_;
    bool ends_in_cr_ = false;  // the lines of the header
    std::size_t position_ = 0;
    std::string_view word_;  // the last one read from text
    std::string current_;    // where we are, for messages
    FaceSoup soup_;
};

}  // namespace

FaceSoup parse_ply(std::string_view bytes, const std::filesystem::path& file) {
    if (bytes.starts_with(k_utf8_mark)) bytes.remove_prefix(k_utf8_mark.size());
    std::string text;
    if (bytes.substr(0, bytes.find("end_header")).find("binary_") == std::string_view::npos)
        bytes = text = decoded_text(bytes, file);
    return PlyParser(bytes, file).parse();
}

std::string ply_text(const Solid& solid, bool with_planes) {
    std::string text = "ply\nformat ascii 1.0\n";
    if (with_planes) text += plane_comments(solid, "comment ");
    text += fmt::format(
        "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "element face {}\nproperty list int int vertex_indices\nend_header\n",
        solid.vertices.size(), solid.facets.size());
    for (const Vec3& v : solid.vertices) text += fmt::format("{} {} {}\n", v.x, v.y, v.z);
    for (const Facet& facet : solid.facets) {
        text += fmt::format("{}", facet.corners.size());
        for (const int corner : facet.corners) text += fmt::format(" {}", corner);
        text += '\n';
    }
    return text;
}

}  // namespace culet
