// Object File Format (Geomview): a header line, the counts, one vertex per line, one face per line.
// The prefixes ST, C and N are known, in any order; their values follow the coordinates. The
// keyword is optional (Geomview's manual, "OFF").

#include <fmt/format.h>

#include "stone/mesh/mesh_formats.h"
#include "stone/text/errors.h"
#include "stone/text/text_decoding.h"

namespace culet {

namespace {

class OffParser {
public:
    OffParser(std::string_view text, const std::filesystem::path& file)
        : text_(text), lines_(text), file_(file) {}

    FaceSoup parse() {
        std::vector<std::string_view> words = next_words("the word OFF");
        read_keyword(words);
        // The counts may follow the keyword on its line.
        if (words.empty()) words = next_words("the counts of vertices and faces");
        const auto vertices = words.size() < 2 ? std::nullopt : integer_in(words[0]);
        const auto faces = words.size() < 2 ? std::nullopt : integer_in(words[1]);
        if (!vertices || !faces || *vertices < 0 || *faces < 0) {
            throw InputError(file_, lines_.line(),
                             "expected the counts of vertices, faces and edges");
        }
        // A vertex takes at least `0 0 0` and a line end.
        const auto room = static_cast<std::int64_t>(text_.size() / 6 + 1);
        if (*vertices > room || *faces > room) {
            throw InputError(file_, lines_.line(),
                             fmt::format("promises {} vertices and {} faces, more than the file "
                                         "has room for: is it cut short?",
                                         *vertices, *faces));
        }
        for (std::int64_t i = 0; i < *vertices; ++i) read_vertex(i, *vertices);
        for (std::int64_t i = 0; i < *faces; ++i) read_face(i, *faces);
        while (const auto line = lines_.next()) {
            const std::string_view rest = trimmed(*line);
            if (rest.starts_with('#')) read_comment(soup_, rest.substr(1));
        }
        if (soup_.vertices.empty() || soup_.faces.empty()) {
            throw InputError(
                file_, fmt::format("holds no mesh: {} vertices and {} faces", *vertices, *faces));
        }
        return std::move(soup_);
    }

private:
    /// Removes the keyword from `words`. Without a keyword the words are the counts.
    void read_keyword(std::vector<std::string_view>& words) {
        if (words.size() >= 2 && words.size() <= 3 && integer_in(words[0]) && integer_in(words[1]))
            return;
        std::string_view keyword = words[0];
        for (bool more = true; more;) {
            more = false;
            for (const std::string_view prefix : {"ST", "C", "N"}) {
                if (!keyword.starts_with(prefix)) continue;
                keyword.remove_prefix(prefix.size());
                more = true;
            }
        }
        if (keyword == "4OFF" || keyword == "nOFF" || keyword == "4nOFF") {
            throw InputError(file_, lines_.line(),
                             "is OFF in more than three dimensions; only three are read");
        }
        if (keyword != "OFF" && keyword != "off") {
            throw InputError(
                file_, lines_.line(),
                fmt::format("an OFF file begins with OFF, found '{}'", shown(words[0])));
        }
        words.erase(words.begin());
        if (!words.empty() && words[0] == "BINARY") {
            throw InputError(file_, lines_.line(), "is binary OFF; only the text form is read");
        }
    }

    /// The next line that is neither blank nor a comment.
    std::vector<std::string_view> next_words(const std::string& expected) {
        while (const auto line = lines_.next()) {
            const std::string_view content = trimmed(*line);
            if (content.starts_with('#')) {
                read_comment(soup_, content.substr(1));
                continue;
            }
            std::vector<std::string_view> words = words_of(content.substr(0, content.find('#')));
            if (!words.empty()) return words;
        }
        throw InputError(file_, lines_.line() + 1,
                         fmt::format("the file ends where {} should be", expected));
    }

    void read_vertex(std::int64_t i, std::int64_t count) {
        const auto words = next_words(fmt::format("vertex {} of {}", i, count));
        // Coordinates, a normal, a colour and texture coordinates.
        constexpr std::size_t k_most_words = 3 + 3 + 4 + 2;
        if (words.size() > k_most_words) {
            throw InputError(file_, lines_.line(),
                             fmt::format("{} numbers stand on the line of vertex {} of {}: write "
                                         "each vertex, and each face, on a line of its own",
                                         words.size(), i, count));
        }
        Vec3 vertex{0, 0, 0};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto number = axis < words.size() ? number_in(words[axis]) : std::nullopt;
            if (!number) {
                throw InputError(
                    file_, lines_.line(),
                    fmt::format("vertex {} of {} needs three coordinates: {}", i, count,
                                axis < words.size() ? not_a_number(words[axis])
                                                    : "found the end of the line"));
            }
            vertex[static_cast<int>(axis)] = *number;
            soup_.precision.add(words[axis], *number);
        }
        soup_.vertices.push_back(vertex);
    }

    void read_face(std::int64_t i, std::int64_t count) {
        const auto words = next_words(fmt::format("face {} of {}", i, count));
        const auto corners = integer_in(words[0]);
        if (!corners || *corners < 1 || *corners > static_cast<std::int64_t>(words.size()) - 1) {
            throw InputError(file_, lines_.line(),
                             fmt::format("face {} of {}: expected a count of corners and as many "
                                         "vertices, found '{}' and {} words",
                                         i, count, shown(words[0]), words.size() - 1));
        }
        SoupFace face;
        for (std::int64_t k = 1; k <= *corners; ++k) {
            const auto index = integer_in(words[static_cast<std::size_t>(k)]);
            if (!index || *index < 0 ||
                *index >= static_cast<std::int64_t>(soup_.vertices.size())) {
                throw InputError(
                    file_, lines_.line(),
                    fmt::format("face {} of {}: '{}' is not a vertex: they count from 0 to {}", i,
                                count, shown(words[static_cast<std::size_t>(k)]),
                                soup_.vertices.size() - 1));
            }
            face.corners.push_back(static_cast<int>(*index));
        }
        soup_.faces.push_back(std::move(face));
    }

    std::string_view text_;
    LineReader lines_;
    const std::filesystem::path& file_;
    FaceSoup soup_;
};

}  // namespace

FaceSoup parse_off(std::string_view bytes, const std::filesystem::path& file) {
    const std::string text = decoded_text(bytes, file);
    return OffParser(text, file).parse();
}

std::string off_text(const Solid& solid, bool with_planes) {
    std::string text = "OFF\n";
    if (with_planes) text += plane_comments(solid, "# ");
    text +=
        fmt::format("{} {} {}\n", solid.vertices.size(), solid.facets.size(), edge_count(solid));
    for (const Vec3& v : solid.vertices) text += fmt::format("{} {} {}\n", v.x, v.y, v.z);
    for (const Facet& facet : solid.facets) {
        text += fmt::format("{}", facet.corners.size());
        for (const int corner : facet.corners) text += fmt::format(" {}", corner);
        text += '\n';
    }
    return text;
}

}  // namespace culet
