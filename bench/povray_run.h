#pragma once
// POV-Ray 3.7, where it is installed, as a second renderer.

#include <string>

#include "render/image/picture.h"
#include "render/scene/scene.h"
#include "tests/scratch_folder.h"

namespace culet {

bool povray_is_installed();

struct PovrayRun {
    Picture picture;  ///< linear; clipped at 1
    /// CPU seconds of tracing as POV-Ray states them (without reading the scene or writing the
    /// picture), quickest run, one thread.
    double seconds = 0;
};

/// Its files are removed at the end.
class PovrayFolder {
public:
    /// `sampling`: POV-Ray's options, "-A" or "+A0.1 +AM2 +R3". Throws InputError with POV-Ray's
    /// message.
    PovrayRun draw(const Scene& scene, const std::string& sampling, int runs) const;

private:
    test::ScratchFolder folder_;
};

}  // namespace culet
