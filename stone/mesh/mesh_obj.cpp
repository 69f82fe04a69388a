// Wavefront OBJ: reads vertices, faces and group names; skips all else (normals, textures,
// materials, lines, curves).

#include <fmt/format.h>

#include <unordered_map>

#include "stone/mesh/mesh_formats.h"
#include "stone/text/errors.h"
#include "stone/text/text_decoding.h"

namespace culet {

namespace {

class ObjParser {
public:
    ObjParser(std::string_view text, const std::filesystem::path& file)
        : lines_(text), file_(file) {}

    FaceSoup parse() {
        while (const auto line = statement()) read(*line);
        for (std::size_t f = 0; f < soup_.faces.size(); ++f) {
            for (const int corner : soup_.faces[f].corners) {
                if (corner < static_cast<int>(soup_.vertices.size())) continue;
                throw InputError(file_, line_of_face_[f],
                                 fmt::format("the face uses vertex {} but the file has only {}",
                                             corner + 1, soup_.vertices.size()));
            }
        }
        if (soup_.vertices.empty() || soup_.faces.empty()) {
            throw InputError(file_, fmt::format("holds no mesh: found {} vertices (v) and {} faces "
                                                "(f)",
                                                soup_.vertices.size(), soup_.faces.size()));
        }
        return std::move(soup_);
    }

private:
    /// Joined with the lines that a backslash continues it on. Text that ends in a backslash
    /// (mtllib C:\gems\) and comments are not continued.
    std::optional<std::string_view> statement() {
        auto line = lines_.next();
        first_line_ = lines_.line();
        if (!line) return line;
        std::string_view content = without_comment(*line);
        if (!content.ends_with('\\') || holds_text(content)) return content;
        joined_.clear();
        while (line && content.ends_with('\\')) {
            joined_.append(content.substr(0, content.size() - 1)).push_back(' ');
            line = lines_.next();
            if (line) content = without_comment(*line);
        }
        if (line) joined_.append(content);
        return joined_;
    }

    std::string_view without_comment(std::string_view line) {
        line = trimmed(line);
        if (line.starts_with('#')) {
            read_comment(soup_, line.substr(1));
            return {};
        }
        for (std::size_t i = 1; i < line.size(); ++i) {
            if (line[i] == '#' && (line[i - 1] == ' ' || line[i - 1] == '\t'))
                return trimmed(line.substr(0, i));
        }
        return line;
    }

    static bool holds_text(std::string_view line) {
        const std::string_view keyword = line.substr(0, line.find_first_of(" \t"));
        for (const char* const of_text : {"g", "o", "mtllib", "usemtl", "maplib", "usemap",
                                          "shadow_obj", "trace_obj", "call"}) {
            if (keyword == of_text) return true;
        }
        return false;
    }

    void read(std::string_view line) {
        // Only keywords of one letter (vn, vt, ... are skipped); `g` may stand alone.
        if (line.empty() || (line.size() == 1 && line != "g")) return;
        if (line.size() > 1 && trimmed(line.substr(1)).size() + 1 == line.size()) return;
        if (line[0] == 'v') {
            read_vertex(words_of(line));
        } else if (line[0] == 'f') {
            read_face(words_of(line));
        } else if (line[0] == 'g') {
            read_group(trimmed(line.substr(1)));
        }
    }

    void read_vertex(const std::vector<std::string_view>& words) {
        if (words.size() < 4 && (words.size() < 2 || number_in(words[1]))) {
            throw InputError(file_, first_line_, "a vertex needs three coordinates after v");
        }
        Vec3 vertex;
        for (int axis = 0; axis < 3; ++axis) {
            const auto number = number_in(words[axis + 1]);
            if (!number) {
                throw InputError(
                    file_, first_line_,
                    not_a_number(words[axis + 1]) + "; a vertex has three coordinates after v");
            }
            vertex[axis] = *number;
            soup_.precision.add(words[axis + 1], *number);
        }
        soup_.vertices.push_back(vertex);
    }

    void read_face(const std::vector<std::string_view>& words) {
        SoupFace face;
        face.name = group_;
        for (std::size_t i = 1; i < words.size(); ++i) {
            // v, v/vt, v//vn, v/vt/vn
            const auto index = integer_in(words[i].substr(0, words[i].find('/')));
            const auto count = static_cast<std::int64_t>(soup_.vertices.size());
            const std::int64_t corner = index ? (*index > 0 ? *index - 1 : count + *index) : -1;
            if (!index || *index == 0 || corner < 0 || corner >= INT32_MAX) {
                throw InputError(file_, first_line_,
                                 fmt::format("'{}' is no corner of a face: vertices count from 1, "
                                             "or from -1 backwards, and there are {} so far",
                                             shown(words[i]), count));
            }
            face.corners.push_back(static_cast<int>(corner));
        }
        if (face.corners.size() < 3) {
            throw InputError(file_, first_line_, "a face needs at least three corners after f");
        }
        soup_.faces.push_back(std::move(face));
        line_of_face_.push_back(first_line_);
    }

    void read_group(std::string_view name) {
        group_ = -1;
        if (name.empty()) return;
        const auto [at, is_new] =
            groups_.try_emplace(std::string(name), static_cast<int>(soup_.names.size()));
        if (is_new) soup_.names.emplace_back(name);
        group_ = at->second;
    }

    LineReader lines_;
    const std::filesystem::path& file_;
    std::string joined_;
    long first_line_ = 0;
    FaceSoup soup_;
    std::vector<long> line_of_face_;
    std::unordered_map<std::string, int> groups_;
    int group_ = -1;
};

}  // namespace

FaceSoup parse_obj(std::string_view bytes, const std::filesystem::path& file) {
    const std::string text = decoded_text(bytes, file);
    return ObjParser(text, file).parse();
}

std::string obj_text(const Solid& solid, bool with_planes) {
    std::string text = with_planes ? plane_comments(solid, "# ") : std::string();
    for (const Vec3& v : solid.vertices) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    const Facet* before = nullptr;
    for (const Facet& facet : solid.facets) {
        // A group lasts until the next one.
        if (!before || before->name != facet.name)
            text += fmt::format("g {}\n", writable_name(facet.name));
        before = &facet;
        text += 'f';
        for (const int corner : facet.corners) text += fmt::format(" {}", corner + 1);
        text += '\n';
    }
    return text;
}

}  // namespace culet
