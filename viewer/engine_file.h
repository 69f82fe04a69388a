#pragma once
// The engine that pages carry: culet's renderer as WebAssembly, a file of its own
// (share/culet/engine.wasm).

#include <string>

namespace culet {

/// The engine as a page holds it: compressed by gzip, in base64. Empty where there is no such file.
/// It is looked for beside the program (share/culet and ../share/culet), then where this library
/// was installed. Throws InputError: the file cannot be read, or is no WebAssembly.
const std::string& engine_for_pages();

}  // namespace culet
