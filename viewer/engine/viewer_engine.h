#pragma once
// The engine behind a page: a document in, pictures out. Compiled into the program for its tests,
// and to WebAssembly for pages (viewer/wasm).

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace culet {

/// Answers a page's calls, in JSON (docs/viewer.md, "The engine's calls"). Pictures equal those of
/// `culet render` with engine "beams" or "preview" and `check = "none"`.
class ViewerEngine {
public:
    explicit ViewerEngine(std::string version);
    ~ViewerEngine();
    ViewerEngine(ViewerEngine&&) noexcept;

    /// `attached`: the document for `open`, the file for `panorama` and `stone`. Throws InputError
    /// with what is wrong, in one line for people, and then changes nothing.
    std::string answer(std::string_view call, std::string_view arguments,
                       std::string_view attached = {});

    static std::vector<std::string_view> calls();

    /// RGBA of the last `draw`, row by row from the top.
    const std::vector<std::uint8_t>& pixels() const;
    /// Linear RGB of the last `radiance`.
    const std::vector<float>& radiance() const;
    /// RGBA of all textures of the last `gpu`.
    const std::vector<float>& texels() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace culet
