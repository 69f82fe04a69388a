#pragma once
// For readers that take a file: the bytes go through a file in memory; only InputError may be
// thrown.

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "stone/text/errors.h"

namespace culet {

template <class Read>
int fuzz_file(const std::uint8_t* data, std::size_t size, const char* extension, Read read) {
    static const std::filesystem::path file =
        std::filesystem::path("/dev/shm") / ("culet-fuzz-" + std::to_string(getpid()) + extension);
    {
        std::ofstream out(file, std::ios::binary);
        out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    }
    try {
        read(file);
    } catch (const InputError&) {
    }
    return 0;
}

}  // namespace culet
