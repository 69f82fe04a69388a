#include "app/input/study_scene.h"

#include <fmt/format.h>

#include "app/program/terminal.h"
#include "compare/report/study_pictures.h"
#include "compare/study/scene_study.h"
#include "page/scene_study_page.h"
#include "render/image/image_io.h"
#include "render/scene/scene_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

int study_scene_file(const StudySceneOptions& options) {
    Scene scene = read_scene(options.input, options.common.set);
    scene.settings.threads = options.common.threads;
    scene.settings.seed = options.common.seed;
    for (const std::string& note : scene.notes) say(note, !options.common.verbose);
    SceneStudyOptions study_options;
    study_options.size = options.size;
    study_options.runs = options.runs;
    study_options.budget_seconds = options.budget;

    const std::filesystem::path folder = study_folder(options.out);
    require_writable(folder / "study.json");
    require_writable(options.json);
    const SceneStudy study =
        study_scene(scene, study_options, progress_line("study", options.common.quiet));

    const std::string json = scene_study_json(study);
    write_text(folder / "study.json", json);
    write_text(folder / "time.csv", scene_study_csv(study));
    write_text(folder / "time.svg", scene_study_chart(json));
    write_picture(study.reference.picture, folder / "reference.exr");
    std::string command = fmt::format("culet study {} -o {} --seed {} --budget {:g}", options.input,
                                      options.out, options.common.seed, options.budget);
    if (options.size > 0) command += fmt::format(" --size {}", options.size);
    for (const std::string& setting : options.common.set) command += " --set " + setting;
    write_text(folder / "report.html",
               scene_study_page({json, study.name, CULET_VERSION, command, study_pictures(study)}));
    if (!options.json.empty()) write_text(options.json, json);
    if (options.json != "-") print_lines(scene_study_table(json));
    const bool quiet = options.common.quiet;
    say(fmt::format("pictures of {} x {} pixels; the reference itself may be off by {:.2g} of the "
                    "mean",
                    study.width, study.height, study.reference.noise.mean),
        quiet);
    for (const std::string& note : study.notes) say(note, quiet);
    if (!study.left_out.empty()) {
        say(fmt::format("{} settings were impossible, or not drawn in {:g} s",
                        study.left_out.size(), options.budget),
            quiet);
    }
    if (!study.usable()) {
        say(fmt::format("not to be trusted at the scene's tolerance: raise --budget, or lower "
                        "--size"),
            quiet);
    }
    say(fmt::format("pages: {}", (folder / "report.html").string()), quiet);
    return study.usable() ? exit_good : exit_untrusted;
}

}  // namespace culet
