#include "compare/calibration/calibrate.h"
#include "render/scene/fingerprint.h"

namespace culet {

namespace {

// Version of the calibration's algorithm: cached tables of another version are not used.
constexpr int k_version = 4;

}  // namespace

std::string calibration_hash(const Scene& model, const CalibrateOptions& options) {
    Fingerprint print;
    print.add(k_version);
    print.add(model);
    const CameraModel& camera = options.camera;
    print.add(camera.psf_px);
    print.add(camera.electrons);
    print.add(camera.read_noise);
    print.add(camera.bits);
    print.add(camera.clips ? 1 : 0);
    print.add(camera.outline_from_background ? 1 : 0);
    print.add(camera.scale_error);
    for (const double g : camera.gain) print.add(g);
    for (const float g : camera.ground) print.add(static_cast<double>(g));
    print.add(options.draws);
    print.add(options.null_draws);
    print.add(static_cast<double>(options.seed));
    print.add(options.view_sigma);
    print.add(options.largest);
    print.add(options.ignored);
    if (options.start) print.add(*options.start);
    return print.hex();
}

}  // namespace culet
