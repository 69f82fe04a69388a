// culet view STONE|SCENE|CUT|DIR -o PAGE: a page in which the stone can be turned by hand.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>

#include "app/program/file_kinds.h"
#include "app/program/options.h"
#include "app/program/other_programs.h"
#include "app/program/scratch_folder.h"
#include "app/program/terminal.h"
#include "stone/cuts/cuts.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "viewer/engine_file.h"
#include "viewer/view_item.h"
#include "viewer/viewer_page.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

struct ViewOptions {
    CommonOptions common;
    std::string input, out = "view.html", report, before;
    StoneScene stone;
    bool open = false;
};

// Lists what can be shown, by name.
std::vector<fs::path> shown_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        try {
            const FileKind kind = kind_of(entry.path());
            if (kind == FileKind::solid || kind == FileKind::stone || kind == FileKind::scene)
                files.push_back(entry.path());
        } catch (const InputError&) {
            files.push_back(entry.path());  // reading it will report what is wrong
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

ViewSource source_of(const ViewOptions& options, const fs::path& file) {
    return {file, options.common.set, options.stone, {}, {}, {}};
}

ViewItem one_item(const ViewOptions& options, std::vector<std::string>& notes) {
    ViewSource source = source_of(options, options.input);
    if (is_cut_name(options.input)) {
        const CutKind& kind = cut_kind(options.input);
        source.cut.emplace();
        source.cut->kind = kind.name;
        for (const CutParameter& parameter : kind.parameters)
            source.cut->values[parameter.name] = parameter.value;
        if (source.choices.material.empty()) source.choices.material = "diamond";
    }
    if (!options.report.empty()) source.fit_json = read_text(options.report);
    source.before = options.before;
    return view_item(source, notes);
}

ViewDocument gallery_of(const ViewOptions& options) {
    if (!options.report.empty() || !options.before.empty())
        throw InputError("--report and --before are for one stone, not for a folder");
    ViewDocument document;
    document.title = fs::absolute(options.input).lexically_normal().filename().string();
    if (document.title.empty()) document.title = "stones";
    const std::vector<fs::path> files = shown_in(options.input);
    const Progress progress = progress_line("reading stones", options.common.quiet);
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (progress && !progress(static_cast<double>(i) / static_cast<double>(files.size())))
            throw Interrupted();
        try {
            std::vector<std::string> notes;
            ViewItem item = view_item(source_of(options, files[i]), notes);
            // Stones of different files may have the same name.
            item.name = files[i].filename().string();
            document.items.push_back(std::move(item));
        } catch (const InputError& error) {
            say(fmt::format("left out: {}", error.what()), options.common.quiet);
        }
    }
    if (document.items.empty())
        throw InputError(options.input, "holds no stone, scene or cut design that can be shown");
    return document;
}

void open_page(const fs::path& page, bool quiet) {
    if (!has_program("xdg-open")) {
        say(fmt::format("no xdg-open here: open {} in a browser", page.string()), quiet);
        return;
    }
    const ScratchFolder scratch;
    if (run_program({"xdg-open", fs::absolute(page).string()}, scratch.path() / "messages.txt") !=
        0)
        say(fmt::format("no browser came up: open {} by hand", page.string()), quiet);
}

int run_view(const ViewOptions& options) {
    const bool quiet = options.common.quiet;
    require_writable(options.out);
    ViewDocument document;
    std::error_code ignored;
    if (fs::is_directory(options.input, ignored)) {
        document = gallery_of(options);
    } else {
        std::vector<std::string> notes;
        document.items.push_back(one_item(options, notes));
        document.title = document.items.front().name;
        for (const std::string& note : notes) say(note, quiet);
        const ViewItem& item = document.items.front();
        if (!item.refused.empty())
            say(fmt::format("the page shows a picture that does not turn: {}", item.refused),
                quiet);
    }
    document.version = CULET_VERSION;
    if (engine_for_pages().empty())
        say("the page shows a picture that does not turn: culet found no share/culet/engine.wasm; "
            "build it with `sh viewer/engine.sh`",
            quiet);
    write_text(options.out, viewer_page(std::move(document)));
    if (options.out == "-") return exit_good;
    say(fmt::format("{}: open it in a browser", options.out), quiet);
    if (options.open) open_page(options.out, quiet);
    return exit_good;
}

}  // namespace

void add_command_view(CLI::App& program, int& exit_code) {
    auto options = std::make_shared<ViewOptions>();
    CLI::App* command = program.add_subcommand("view", "a page in which a stone turns in the hand");
    command
        ->add_option("input", options->input,
                     "stone or scene file, mesh, cut design, the name of a standard cut, or a "
                     "folder of them")
        ->required()
        ->type_name("STONE|SCENE|CUT|DIR");
    command->add_option("-o,--output", options->out, "page (view.html); - is stdout")
        ->type_name("PAGE.html");
    command->add_flag("--open", options->open, "open it in the browser");
    command->add_option("--material", options->stone.material, "of the stone, instead of its own")
        ->type_name("NAME");
    command
        ->add_option("--light", options->stone.light,
                     "to begin with, as culet render has them; a stone without a scene: photograph")
        ->type_name("PRESET");
    command
        ->add_option("--width", options->stone.width_mm,
                     "of a stone without a scene, mm; a design without a size: 6.5")
        ->type_name("MM");
    command
        ->add_option("--report", options->report,
                     "of culet fit: facets are coloured by their residuals and uncertainties")
        ->type_name("FIT.json");
    command
        ->add_option("--before", options->before,
                     "the stone that the fit began with, to be compared")
        ->type_name("STONE");
    add_common(*command, options->common, true);
    command->footer(
        "Examples:\n"
        "  culet view round-brilliant -o brilliant.html\n"
        "  culet view fitted.obj --material diamond --report fit.json --before start.obj --open\n"
        "  culet view samples/dravite-step/scene.toml -o dravite.html\n"
        "  culet view designs -o designs.html --material sapphire_blue");
    command->callback([options, &exit_code] { exit_code = run_view(*options); });
}

}  // namespace culet
