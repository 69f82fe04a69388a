// culet studio [FOLDER|STONE|DESIGN]: the stone, its readings and its fit in a browser's window.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "app/program/options.h"
#include "app/program/other_programs.h"
#include "app/program/scratch_folder.h"
#include "app/program/terminal.h"
#include "stone/text/output_file.h"
#include "studio/studio.h"

namespace culet {

namespace {

struct StudioCommand {
    CommonOptions common;
    std::string input = ".";
    int port = 0;
    bool no_open = false;
};

// Some browsers keep the program that opens them waiting, as long as they run.
void open_window(const std::filesystem::path& page, bool quiet) {
    if (!has_program("xdg-open")) {
        say("no xdg-open here: open the address in a browser", quiet);
        return;
    }
    std::thread([page, quiet] {
        if (run_program({"xdg-open", page.string()}, "/dev/null") != 0)
            say("no browser came up: open the address by hand", quiet);
    }).detach();
}

int run_studio(const StudioCommand& command) {
    Studio studio({command.input, command.port, CULET_VERSION});
    print_lines(studio.address());
    std::fflush(stdout);
    say("Ctrl-C ends the studio; every change is saved when it is made", command.common.quiet);
    const ScratchFolder scratch;
    if (!command.no_open) {
        write_text(scratch.path() / "studio.html", studio.opening_page());
        open_window(scratch.path() / "studio.html", command.common.quiet);
    }
    studio.run([] { return !interrupted(); });
    return exit_good;
}

}  // namespace

void add_command_studio(CLI::App& program, int& exit_code) {
    auto command = std::make_shared<StudioCommand>();
    CLI::App* studio = program.add_subcommand(
        "studio", "readings, stone and fit in a window of the browser, every number live");
    studio
        ->add_option("input", command->input,
                     "a stone's folder or stone file, a mesh or a design; a folder of several "
                     "stones, or none (the folder you are in): to begin with")
        ->type_name("FOLDER|STONE|DESIGN");
    studio->add_option("--port", command->port, "of 127.0.0.1, to listen on (a free one)")
        ->check(CLI::Range(1, 65535))
        ->type_name("N");
    studio->add_flag("--no-open", command->no_open, "print the address and open no browser");
    add_common(*studio, command->common);
    studio->footer(
        "Examples:\n"
        "  culet studio\n"
        "  culet studio samples/cutters-evening/stone.toml\n"
        "  culet studio design.asc --no-open --port 8080   (over ssh -L 8080:127.0.0.1:8080)");
    studio->callback([command, &exit_code] { exit_code = run_studio(*command); });
}

}  // namespace culet
