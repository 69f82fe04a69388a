// The engine's functions for a page's worker; texts and bytes are passed by their place in memory.

#include <emscripten/emscripten.h>

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <string>

#include "stone/text/errors.h"
#include "viewer/engine/viewer_engine.h"

namespace {

culet::ViewerEngine& engine() {
    static culet::ViewerEngine only(CULET_VERSION);
    return only;
}

std::string last_answer;

std::string refusal(const char* what) {
    using Json = nlohmann::ordered_json;
    return Json{{"error", culet::for_terminal(what)}}.dump(-1, ' ', false,
                                                           Json::error_handler_t::replace);
}

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE void* culet_take(std::size_t size) {
    return std::malloc(size);
}
EMSCRIPTEN_KEEPALIVE void culet_give_back(void* place) {
    std::free(place);
}

/// 1: `culet_answer` is the answer; 0: it is {"error": "..."}.
EMSCRIPTEN_KEEPALIVE int culet_call(const char* call, std::size_t call_size, const char* arguments,
                                    std::size_t arguments_size, const char* attached,
                                    std::size_t attached_size) {
    try {
        last_answer = engine().answer({call, call_size}, {arguments, arguments_size},
                                      {attached, attached_size});
        return 1;
    } catch (const std::bad_alloc&) {
        last_answer = refusal("this needs more memory than a page has: ask for a smaller picture");
    } catch (const std::exception& error) {
        last_answer = refusal(error.what());
    }
    return 0;
}
EMSCRIPTEN_KEEPALIVE const char* culet_answer() {
    return last_answer.data();
}
EMSCRIPTEN_KEEPALIVE std::size_t culet_answer_size() {
    return last_answer.size();
}
EMSCRIPTEN_KEEPALIVE const std::uint8_t* culet_pixels() {
    return engine().pixels().data();
}
EMSCRIPTEN_KEEPALIVE std::size_t culet_pixels_size() {
    return engine().pixels().size();
}
EMSCRIPTEN_KEEPALIVE const float* culet_radiance() {
    return engine().radiance().data();
}
EMSCRIPTEN_KEEPALIVE std::size_t culet_radiance_size() {
    return engine().radiance().size();
}

EMSCRIPTEN_KEEPALIVE const float* culet_texels() {
    return engine().texels().data();
}
EMSCRIPTEN_KEEPALIVE std::size_t culet_texels_size() {
    return engine().texels().size();
}

}  // extern "C"
