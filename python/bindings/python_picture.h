#pragma once
// Pictures as Python has them: a dict of arrays.

#include "python/bindings/arrays.h"
#include "render/image/picture.h"

namespace culet {

/// rgb (H, W, 3) and, None where there is none, coverage (H, W), wavelengths_nm (B,), spectral
/// (B, H, W), stokes (4, B, H, W), and planes: a dict of (H, W) by their channels in an EXR.
pybind11::dict arrays_of(const Picture& picture);

/// Back from the same keys, all but rgb may be missing. Throws InputError where shapes do not
/// agree.
Picture picture_of(const pybind11::dict& arrays);

}  // namespace culet
