#include "app/program/file_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "stone/cuts/cuts.h"
#include "stone/file_kind.h"
#include "stone/text/errors.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

struct KindWords {
    const char* written;   ///< `a scene (TOML with [camera] and [light])`
    const char* taken_by;  ///< commands for it
};

KindWords words_of(FileKind kind) {
    switch (kind) {
        case FileKind::solid:
            return {"a mesh or cut (.obj .off .ply .stl .asc .gem .gcs)",
                    "culet info and culet convert take it, and a stone file names it: [stone] mesh "
                    "= \"...\""};
        case FileKind::stone:
            return {"a stone file (TOML with [stone] and its readings)",
                    "culet fit and culet info take it, and a scene names it: stone = \"...\""};
        case FileKind::scene:
            return {"a scene (TOML with a stone, [camera] and [light])",
                    "culet render, probe and study take it"};
        case FileKind::job:
            return {"a job (TOML with [fit] and [render])", "culet run takes it"};
        case FileKind::material:
            return {"a material (TOML with [material])",
                    "a stone or scene names it: material = \"...\""};
        case FileKind::picture:
            return {"a picture (.png .jpg .tif .exr .hdr)", "culet compare and culet info take it"};
        case FileKind::table:
            return {"a table of readings (.csv)",
                    "a stone file names it: [stone] readings = \"...\""};
        case FileKind::unknown:
            break;
    }
    return {"", ""};
}

// Recognised by the text that culet render writes into a picture's header.
bool is_render(const std::filesystem::path& file) {
    constexpr std::size_t k_longest_header = 1 << 16;
    std::ifstream stream(file, std::ios::binary);
    std::string bytes(k_longest_header, '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    return bytes.find("culet:scene") != std::string::npos;
}

}  // namespace

void require_kind(const std::filesystem::path& file, const std::vector<FileKind>& taken,
                  const std::string& command, const std::vector<std::string>& overrides) {
    const FileKind kind = kind_of(file, overrides);
    if (kind == FileKind::unknown || std::find(taken.begin(), taken.end(), kind) != taken.end())
        return;
    std::string takes;
    for (const FileKind one : taken) {
        takes += fmt::format("{}{}", takes.empty() ? "" : " or ", words_of(one).written);
    }
    throw InputError(file, fmt::format("is {}, and {} takes {}; {}", words_for(kind), command,
                                       takes, words_of(kind).taken_by));
}

bool is_cut_name(const std::string& input) {
    std::error_code ignored;
    if (std::filesystem::exists(input, ignored)) return false;
    return std::any_of(cut_kinds().begin(), cut_kinds().end(),
                       [&](const CutKind& kind) { return kind.name == input; }) ||
           input == "emerald";
}

void require_photographs_first(const std::vector<std::string>& pictures, bool simulated,
                               const std::vector<std::string>& overrides) {
    const std::string& last = pictures.back();
    for (std::size_t i = 0; i + 1 < pictures.size(); ++i) {
        if (extension_of(pictures[i]) == "toml") {
            throw InputError(pictures[i],
                             fmt::format("is not a picture: photographs come first and a scene "
                                         "last, culet compare {} {} -o DIR",
                                         last, pictures[i]));
        }
        require_kind(pictures[i], {FileKind::picture}, "culet compare");
    }
    require_kind(last, {FileKind::picture, FileKind::scene}, "culet compare", overrides);
    const std::string& first = pictures.front();
    if (simulated || extension_of(last) == "toml" || !is_render(first) || is_render(last)) return;
    throw InputError(first, fmt::format("was rendered by culet and {1} was not: the photograph "
                                        "comes first, culet compare {1} {0} -o DIR (a render that "
                                        "stands for a photograph needs --simulated)",
                                        first, last));
}

}  // namespace culet
