#include "bench/povray_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "render/export/povray.h"
#include "render/image/image_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

double trace_seconds(const std::string& messages) {
    const std::size_t trace = messages.find("Trace Time:");
    const std::size_t with = trace == std::string::npos ? trace : messages.find("with ", trace);
    if (with == std::string::npos)
        throw InputError("POV-Ray did not say how long it traced:\n" + messages);
    return std::strtod(messages.c_str() + with + 5, nullptr);
}

}  // namespace

bool povray_is_installed() {
    return std::system("command -v povray >/dev/null 2>&1") == 0;
}

PovrayRun PovrayFolder::draw(const Scene& scene, const std::string& sampling, int runs) const {
    const std::string in = (folder_ / "scene.pov").string(),
                      out = (folder_ / "picture.png").string(),
                      said = (folder_ / "messages.txt").string();
    write_text(in, povray_scene(scene).text);
    const std::string command =
        fmt::format("povray '+I{}' '+O{}' +W{} +H{} {} -D -V +WT1 +FN16 File_Gamma=sRGB >'{}' 2>&1",
                    in, out, scene.camera.width, scene.camera.height, sampling, said);
    PovrayRun result;
    for (int i = 0; i < runs; ++i) {
        if (std::system(command.c_str()) != 0)
            throw InputError("POV-Ray failed:\n" + read_text(said));
        const double took = trace_seconds(read_text(said));
        result.seconds = i == 0 ? took : std::min(result.seconds, took);
    }
    result.picture = read_picture(out).picture;
    return result;
}

}  // namespace culet
