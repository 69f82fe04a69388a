#include "app/grade/optimize_options.h"

namespace culet {

void add_optimize_options(CLI::App& optimize, OptimizeCommand& command) {
    optimize.add_option("stone", command.file, "stone, mesh or cut design: closed and convex")
        ->required()
        ->type_name("STONE|CUT");
    optimize.add_option("-o,--output", command.out, "the better design")
        ->required()
        ->type_name("BETTER.asc");
    optimize
        .add_option("--objective", command.objective,
                    "brilliance, fire, contrast or tilt, or several with weights (brilliance)")
        ->type_name("WORDS");
    optimize
        .add_option(
            "--model", command.model,
            "light of brilliance: iso (even), cos (from above, the default), sc2 (from the sides), "
            "random (uneven) or wlr (GIA's weights)")
        ->type_name("MODEL");
    optimize.add_option("--page", command.page, "folder for a page with before and after")
        ->type_name("DIR");
    optimize.add_option("--json", command.json, "merits and angles (- is stdout)")
        ->type_name("FILE");
    optimize.add_option("--material", command.choices.material, "material by name or file")
        ->type_name("NAME");
    optimize.add_option("--index", command.index, "refractive index, instead of the material's")
        ->type_name("N");
    optimize
        .add_option("--head", command.head_deg, "half angle of the viewer's head, degrees (10)")
        ->check(CLI::Range(0.0, 89.0))
        ->type_name("DEG");
    optimize.add_option("--range", command.range_deg, "most change of an angle, degrees (8)")
        ->check(CLI::Range(0.01, 45.0))
        ->type_name("DEG");
    optimize
        .add_option("--over-critical", command.over_critical_deg,
                    "pavilion angles stay so much above the critical angle, degrees (0)")
        ->check(CLI::Range(0.0, 30.0))
        ->type_name("DEG");
    optimize
        .add_option("--least-volume", command.least_volume_percent,
                    "of the design's, for the same outline, per cent (80)")
        ->check(CLI::Range(0.0, 100.0))
        ->type_name("PERCENT");
    optimize.add_option("--table", command.table, "width of the table, per cent of the stone's")
        ->type_name("LEAST:MOST");
    optimize.add_option("--evaluations", command.evaluations, "cuts to try (400)")
        ->check(CLI::Range(40, 100000))
        ->type_name("N");
    optimize.add_flag("--recut", command.recut, "the better cut must fit inside the stone");
    optimize
        .add_option("--gain", command.gain,
                    "with --recut: points of merit to win at the least loss of weight")
        ->check(CLI::Range(0.0, 100.0))
        ->type_name("POINTS");
    optimize
        .add_option("--most-loss", command.most_loss_percent,
                    "with --recut and no --gain: weight that may be cut away, per cent (10)")
        ->check(CLI::Range(0.0, 100.0))
        ->type_name("PERCENT");
    add_common(optimize, command.common, true);
}

}  // namespace culet
