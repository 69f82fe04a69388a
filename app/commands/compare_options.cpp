#include "app/commands/compare_options.h"

namespace culet {

std::string verdict_words(Verdict verdict) {
    return verdict == Verdict::no_evidence ? "no evidence that it is this stone" : name_of(verdict);
}

void add_compare_options(CLI::App& command, CompareArguments& a) {
    command
        .add_option("PHOTO", a.pictures,
                    "photographs (PNG, JPEG, TIFF, EXR or HDR), then the render (best the .exr, "
                    "which is linear) or the scene file")
        ->required()
        ->expected(1, 1000)
        ->type_name("PHOTO... RENDER|SCENE.toml");
    command.add_option("-o,--output", a.folder, "folder for the report; made if missing")
        ->required()
        ->type_name("DIR");
    command.add_option("--json", a.json, "scores for programs; - is stdout")->type_name("FILE");
    command
        .add_option("--mask", a.mask, "picture of the photograph's size, white where the stone is")
        ->type_name("FILE");
    command
        .add_option(
            "--ignore", a.ignored,
            "picture of the photograph's size, white where nothing is to be compared (dust, "
            "inclusions, a holder); may be given several times")
        ->type_name("MASK")
        ->allow_extra_args(false);
    command.add_flag("--simulated", a.simulated,
                     "the photograph was computed: say so wherever it appears");
    command.add_flag("--calibrate", a.calibrate,
                     "say what the scores mean for this stone, pose and light (scenes only)");
    command
        .add_option("--budget", a.budget,
                    "time for a photograph with its calibration, seconds of two processors, by "
                    "counted work: more time, finer answers (0: no limit)")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    command
        .add_option("--draws", a.draws,
                    "at most, for each facet error; for a wrong light or pose, 3x")
        ->check(CLI::Range(2, 1000))
        ->capture_default_str();
    command
        .add_option("--cache", a.cache,
                    "folder that keeps calibrations for the next photograph of the same scene "
                    "(without it: DIR/cache)")
        ->type_name("DIR");
    command
        .add_option("--start", a.start,
                    "mesh that the fit started from: would it have matched as well?")
        ->type_name("MESH");
    command
        .add_option("--uncertainty", a.uncertainty,
                    "report of the stone's fit: how much of the photograph agrees with its "
                    "readings' uncertainty (scenes only; 100 random stones)")
        ->type_name("FIT.json");
    command.add_flag("--keep-pose", a.keep_pose,
                     "the scene's camera stands where it says: no pose is looked for");
    add_common(command, a.common, true);
}

}  // namespace culet
