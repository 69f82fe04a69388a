#include "viewer/engine_file.h"

#include <zlib.h>

#include <filesystem>
#include <string_view>
#include <vector>

#include "page/html.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t k_most_bytes = std::size_t{64} << 20;

fs::path engine_file() {
    std::error_code ignored;
    std::vector<fs::path> places;
    if (const fs::path program = fs::read_symlink("/proc/self/exe", ignored); !program.empty()) {
        places.push_back(program.parent_path() / "share/culet/engine.wasm");
        places.push_back(program.parent_path().parent_path() / "share/culet/engine.wasm");
    }
    places.emplace_back(CULET_INSTALLED_ENGINE);
    for (const fs::path& place : places) {
        if (fs::is_regular_file(place, ignored)) return place;
    }
    return {};
}

// Without a name and a time, so that the same engine gives the same bytes.
std::string gzipped(const std::string& bytes) {
    z_stream stream{};
    constexpr int k_level = 9, k_gzip = 16, k_memory = 8;
    check(deflateInit2(&stream, k_level, Z_DEFLATED, MAX_WBITS + k_gzip, k_memory,
                       Z_DEFAULT_STRATEGY) == Z_OK,
          "zlib compresses");
    std::string packed(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    const int ended = deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    check(ended == Z_STREAM_END, "zlib compresses all of a text at once");
    return packed;
}

std::string packed_engine() {
    const fs::path file = engine_file();
    if (file.empty()) return {};
    const std::string bytes = read_text(file, k_most_bytes);
    constexpr std::string_view k_magic{"\0asm", 4};  // WebAssembly Core Specification, 5.5.16
    if (!bytes.starts_with(k_magic))
        throw InputError(file, "is not WebAssembly: make it again with `sh viewer/engine.sh`");
    return base64(gzipped(bytes));
}

}  // namespace

const std::string& engine_for_pages() {
    static const std::string engine = packed_engine();
    return engine;
}

}  // namespace culet
