#pragma once
// The engine that pages carry: culet's renderer as WebAssembly, in its own file
// (share/culet/engine.wasm).

#include <string>

namespace culet {

/// The engine compressed by gzip, in base64. Empty if there is no such file beside the program
/// (share/culet and ../share/culet) or where this library was installed. Throws InputError when it
/// cannot be read or is not WebAssembly.
const std::string& engine_for_pages();

}  // namespace culet
