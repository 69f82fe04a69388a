#pragma once
// An EXR's bytes in memory, checked before the library reads them.

#include <ImathBox.h>
#include <ImfIO.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace culet {

/// The library reads from files or from a stream of ours.
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

/// Throws InputError: deep, of several parts, cut off; windows and tiles that would take far more
/// memory than the file can fill.
void check_exr(const std::string& bytes, const std::filesystem::path& file);

}  // namespace culet
