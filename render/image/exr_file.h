#pragma once
// Checks an EXR's bytes in memory before OpenEXR reads them.

#include <ImathBox.h>
#include <ImfIO.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace culet {

/// An input stream over the bytes.
class ExrStream : public Imf::IStream {
public:
    ExrStream(const std::string& bytes, const char* name) : Imf::IStream(name), bytes_(bytes) {}
    bool read(char c[], int n) override;
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = position; }

private:
    const std::string& bytes_;
    std::uint64_t at_ = 0;
};

struct ExrWindow {
    int width = 0, height = 0;
};
ExrWindow size_of(const Imath::Box2i& window);

/// Throws InputError for deep, multi-part and cut off files, and for windows and tiles that take
/// far more memory than the file can fill.
void check_exr(const std::string& bytes, const std::filesystem::path& file);

}  // namespace culet
