#include "app/describe/cutting_sheet_file.h"

#include <fmt/format.h>

#include "app/input/grade_input.h"
#include "app/input/readings_form.h"
#include "page/cutting_sheet.h"
#include "refine/fit_uncertainty.h"
#include "stone/mesh/mesh_io.h"
#include "stone/numbers/units.h"
#include "stone/solid_input.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

namespace culet {

void write_cutting_sheet(const SheetOptions& options, const DescribeOptions& describe) {
    const std::string ending = extension_of(options.out);
    if (options.out != "-" && ending != "html" && ending != "txt") {
        throw InputError(options.out,
                         "a cutting sheet is a page (.html) or text (.txt, or - for stdout)");
    }
    if (!is_solid_file(describe.file)) {
        throw InputError(describe.file,
                         "a cutting sheet is of a mesh or a cut design: fit a stone first (culet "
                         "fit STONE.toml -o FITTED.obj --report FIT.json)");
    }
    SolidInput input = load_solid(describe.file, describe.cut);
    if (describe.width_mm > 0) scale_to_width(input.solid, describe.width_mm);
    CuttingSheet sheet;
    sheet.name = describe.file.stem().string();
    sheet.version = CULET_VERSION;
    sheet.design = cutting_design(input.solid);
    sheet.steps = cutting_list(input.solid, describe.cutting);
    sheet.teeth = gear_of(input.solid, describe.cutting);
    // A design has no unit; a mesh of a stone's size is in mm.
    const bool is_mesh = mesh_format(describe.file).has_value();
    if (describe.width_mm > 0 || (is_mesh && doubtful_size(input.solid).empty())) sheet.unit = "mm";
    if (!options.report.empty()) {
        Stone stone;
        stone.solid = input.solid;
        const StoneUncertainty known = uncertainty_in(options.report, stone);
        for (const CuttingStep& step : sheet.steps) {
            double most = 0;
            for (const int f : step.facets)
                most = std::max(most, known.facets[std::size_t(f)].inclination);
            sheet.sigmas_deg.push_back(degrees(most));
        }
    }
    sheet.solid = std::move(input.solid);
    const bool page = ending == "html";
    write_text(options.out, page ? cutting_sheet_page(sheet) : cutting_sheet_text(sheet));
}

}  // namespace culet
