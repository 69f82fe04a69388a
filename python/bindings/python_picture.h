#pragma once
// Pictures in Python: a dict of arrays.

#include "python/bindings/arrays.h"
#include "render/image/picture.h"

namespace culet {

/// Keys: rgb (H, W, 3) and, None if absent, coverage (H, W), wavelengths_nm (B,), spectral (B, H,
/// W), stokes (4, B, H, W), and planes: a dict of (H, W) by their channel in an EXR.
pybind11::dict arrays_of(const Picture& picture);

/// The reverse; all keys except rgb may be missing. Throws InputError where shapes disagree.
Picture picture_of(const pybind11::dict& arrays);

}  // namespace culet
