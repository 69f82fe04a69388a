#pragma once
// POV-Ray 3.7, where it is installed, as a second renderer.

#include <string>

#include "render/image/picture.h"
#include "render/scene/scene.h"
#include "tests/scratch_folder.h"

namespace culet {

bool povray_is_installed();

struct PovrayRun {
    Picture picture;  ///< linear; what was above 1 is 1
    /// CPU seconds of tracing by its own statement, without reading the scene or writing the
    /// picture: the quickest of the runs, on one thread.
    double seconds = 0;
};

/// A folder of its own for POV-Ray's files, gone at the end.
class PovrayFolder {
public:
    /// `sampling`: POV-Ray's options, "-A" or "+A0.1 +AM2 +R3". Throws InputError with what POV-Ray
    /// said.
    PovrayRun draw(const Scene& scene, const std::string& sampling, int runs) const;

private:
    test::ScratchFolder folder_;
};

}  // namespace culet
