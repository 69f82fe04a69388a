#pragma once
// The engine that pages carry: culet's renderer as WebAssembly, in its own file
// (share/culet/engine.wasm).

#include <string>

namespace culet {

/// The engine compressed by gzip, in base64. Empty if there is no such file. It is looked for
/// beside the program (share/culet and ../share/culet), then where this library was installed.
/// Throws InputError when the file cannot be read or is not WebAssembly.
const std::string& engine_for_pages();

}  // namespace culet
