#include "render/image/codecs/tiff_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace culet {

namespace {

constexpr tmsize_t k_most_tiff_memory = tmsize_t{1} << 31;  // libtiff's largest single allocation

tmsize_t give_tiff_bytes(thandle_t handle, void* to, tmsize_t count) {
    auto* input = static_cast<TiffInput*>(handle);
    if (count <= 0 || input->at >= input->bytes->size()) return 0;
    const std::size_t given = std::min(static_cast<std::size_t>(count),
                                       input->bytes->size() - static_cast<std::size_t>(input->at));
    std::memcpy(to, input->bytes->data() + input->at, given);
    input->at += given;
    return static_cast<tmsize_t>(given);
}

tmsize_t take_no_tiff_bytes(thandle_t, void*, tmsize_t) {
    return 0;
}

toff_t seek_tiff(thandle_t handle, toff_t offset, int from) {
    auto* input = static_cast<TiffInput*>(handle);
    const toff_t start = from == SEEK_SET   ? 0
                         : from == SEEK_CUR ? input->at
                                            : static_cast<toff_t>(input->bytes->size());
    return input->at = start + offset;
}

int close_tiff(thandle_t) {
    return 0;
}

toff_t tiff_size(thandle_t handle) {
    return static_cast<TiffInput*>(handle)->bytes->size();
}

// Maps the file in memory, which libtiff only reads. Without it libtiff 4.5 refuses uncompressed
// tiles whose bytes are no multiple of 1024 (it compares them with its buffer's size).
int map_tiff(thandle_t handle, void** base, toff_t* size) {
    const auto* input = static_cast<TiffInput*>(handle);
    *base = const_cast<char*>(input->bytes->data());
    *size = input->bytes->size();
    return 1;
}

void unmap_tiff(thandle_t, void*, toff_t) {}

int keep_tiff_complaint(TIFF*, void* kept, const char*, const char* format, va_list values) {
    auto* input = static_cast<TiffInput*>(kept);
    if (input->complaint[0] == '\0')
        std::vsnprintf(input->complaint.data(), input->complaint.size(), format, values);
    return 1;
}

int ignore_tiff_warning(TIFF*, void*, const char*, const char*, va_list) {
    return 1;
}

}  // namespace

OpenTiff opened_tiff(TiffInput& input) {
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    check(options != nullptr, "libtiff starts");
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, k_most_tiff_memory);
    TIFFOpenOptionsSetErrorHandlerExtR(options, keep_tiff_complaint, &input);
    TIFFOpenOptionsSetWarningHandlerExtR(options, ignore_tiff_warning, &input);
    TIFF* tiff = TIFFClientOpenExt("TIFF", "r", &input, give_tiff_bytes, take_no_tiff_bytes,
                                   seek_tiff, close_tiff, tiff_size, map_tiff, unmap_tiff, options);
    TIFFOpenOptionsFree(options);
    return {tiff, TIFFClose};
}

InputError tiff_refusal(const TiffInput& input, const std::filesystem::path& file) {
    const std::string what = input.complaint.data();
    return {file, fmt::format("is a broken or unusual TIFF{}: save it again with another program",
                              what.empty() ? "" : " (" + what + ")")};
}

}  // namespace culet
