#include "app/input/readings_form.h"

#include <fmt/format.h>

#include "fit/readings/readings_template.h"
#include "page/form_page.h"
#include "stone/design/index_names.h"
#include "stone/design/proportions.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"
#include "stone/text/written_number.h"

namespace culet {

void add_form_options(CLI::App& command, FormOptions& options) {
    command
        .add_option("--readings", options.readings,
                    "a form of the readings that a bench can take, values empty (- is stdout)")
        ->type_name("FORM.csv");
    command
        .add_option("--form", options.page,
                    "the form of --readings to be printed: drawings with the facets' names, and a "
                    "table to write in")
        ->type_name("FORM.html");
    command
        .add_option("--stone", options.stone,
                    "a stone file of mesh and form: fill the form in, then culet fit")
        ->type_name("STONE.toml");
}

void require_form(const FormOptions& options) {
    if (!options.material.empty()) catalogue_material(options.material);
    if (!options.stone.empty() && (options.readings.empty() || options.readings == "-")) {
        throw InputError("--stone names the form of --readings: give both, as files");
    }
    if (!options.page.empty() && (options.readings.empty() || options.readings == "-")) {
        throw InputError("--form prints the form of --readings: give both, as files");
    }
    if (!options.page.empty() && extension_of(options.page) != "html") {
        throw InputError(options.page, "the printed form is a page: name it FORM.html");
    }
    if (!options.stone.empty() && options.stone == options.readings) {
        throw InputError("--stone and --readings name the same file");
    }
    require_writable(options.readings);
    require_writable(options.page);
    require_writable(options.stone);
}

namespace {

std::string printed(const FormOptions& options, const Stone& stone, const ReadingsForm& form) {
    PrintedForm page;
    page.name = stone.name;
    page.version = CULET_VERSION;
    page.solid = stone.solid;
    const std::vector<std::string> names = index_names(stone.solid, options.gear);
    for (std::size_t f = 0; f < names.size(); ++f) page.solid.facets[f].name = names[f];
    for (const FormRow& row : form.rows) page.rows.push_back({row.kind, row.of, row.note});
    page.readings = options.readings.filename().string();
    return form_page(page);
}

}  // namespace

std::vector<std::string> write_form(const FormOptions& options, Stone stone, bool has_material,
                                    const std::filesystem::path& mesh) {
    std::vector<std::string> lines;
    if (options.readings.empty()) return lines;
    if (!options.material.empty()) {
        stone.material = catalogue_material(options.material);
        has_material = true;
    }
    const ReadingsForm form = readings_form(stone, has_material, options.gear);
    write_text(options.readings, form.csv);
    lines.push_back(fmt::format("{}: {} rows to fill in; rows that stay empty are skipped",
                                options.readings.string(), form.rows.size()));
    if (!options.page.empty()) {
        write_text(options.page, printed(options, stone, form));
        lines.push_back(fmt::format("{}: the same to be printed, with drawings of the facets",
                                    options.page.string()));
    }
    if (options.stone.empty()) return lines;
    write_text(options.stone, stone_file_text(stone, options.stone, mesh, options.readings,
                                              options.material, form.up_facet));
    lines.push_back(fmt::format("next: fill in {}, then culet fit {} -o fitted.obj",
                                options.readings.string(), options.stone.string()));
    return lines;
}

double number_in_unit(const std::string& text, const std::string& unit, const std::string& option) {
    const WrittenNumber number = written_number(text, false);
    if (!number.problem.empty()) throw InputError(fmt::format("{} {}", option, number.problem));
    using Of = WrittenUnit::Of;
    const Of wanted = unit == "mm"    ? Of::length
                      : unit == "%"   ? Of::percent
                      : unit == "deg" ? Of::angle
                                      : Of::none;
    if (number.unit.of != Of::none && number.unit.of != wanted) {
        throw InputError(
            fmt::format("{} is '{}'; expected {}", option, text,
                        unit.empty() ? "a number alone" : fmt::format("a number in {}", unit)));
    }
    return number.value * number.unit.factor;
}

double length_mm(const std::string& text, const std::string& option) {
    return number_in_unit(text, "mm", option);
}

void scale_to_width(Solid& solid, double width_mm) {
    const double width = proportions(solid).width;
    if (!(width > 0)) throw InputError("--width: the stone has no width to be scaled");
    if (!(width_mm > 0 && width_mm <= 1e6)) {
        throw InputError(
            fmt::format("--width {:g}: expected millimetres, such as 6.5mm", width_mm));
    }
    const double factor = width_mm / width;
    for (Vec3& v : solid.vertices) v *= factor;
    for (Facet& facet : solid.facets) facet.plane.offset *= factor;
}

}  // namespace culet
