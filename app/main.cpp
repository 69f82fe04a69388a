// culet COMMAND INPUT... [options]: parses, calls, writes; the one place where errors are caught.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "app/options.h"
#include "app/terminal.h"
#include "stone/errors.h"
#include "stone/toml_file.h"

namespace {

// Control characters of a hostile file name or field must not reach the terminal; one error is one
// line.
std::string printable(std::string text) {
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    }
    return text;
}

int complain(int code, const std::string& message) {
    const bool colour = isatty(STDERR_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr;
    fmt::print(stderr, "{}culet: error:{} {}\n", colour ? "\033[1;31m" : "",
               colour ? "\033[0m" : "", printable(message));
    return code;
}

int run(int argc, char** argv) {
    using namespace culet;
    CLI::App program{
        "culet fits a hand-made gem model to its measurements, renders it with polarised light and "
        "compares the picture with a photograph."};
    program.name("culet");
    program.set_version_flag("--version", std::string("culet ") + CULET_VERSION);
    program.require_subcommand(1);
    program.footer(
        "Examples:\n"
        "  culet cut round-brilliant -o brilliant.obj\n"
        "  culet fit stone.toml -o fitted.obj --report fit.json\n"
        "Exit codes: 0 good, 1 done but not to be trusted, 2 could not be done, 3 our fault, 130 "
        "interrupted.");
    int exit_code = exit_good;
    add_command_fit(program, exit_code);
    add_command_render(program, exit_code);
    add_command_register(program, exit_code);
    add_command_compare(program, exit_code);
    add_command_photo(program, exit_code);
    add_command_light(program, exit_code);
    add_command_camera(program, exit_code);
    add_command_run(program, exit_code);
    add_command_study(program, exit_code);
    add_command_probe(program, exit_code);
    add_command_cut(program, exit_code);
    add_command_convert(program, exit_code);
    add_command_info(program, exit_code);
    std::vector<std::string> commands;
    for (const CLI::App* command : program.get_subcommands({})) {
        commands.push_back(command->get_name());
    }
    const bool names_a_command = argc > 1 && argv[1][0] != '-';
    if (names_a_command && std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
        const auto near = nearest_name(argv[1], commands);
        return complain(exit_impossible,
                        fmt::format("no command \"{}\"{} (see culet --help)", argv[1],
                                    near ? fmt::format(", did you mean \"{}\"?", *near) : ""));
    }
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
        return complain(exit_impossible, fmt::format("{} (see culet --help)", error.what()));
    }
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    culet::catch_interrupts();
    try {
        return run(argc, argv);
    } catch (const culet::InputError& error) {
        return complain(culet::exit_impossible, error.what());
    } catch (const culet::Interrupted&) {
        return complain(culet::exit_interrupted, "interrupted; nothing was written");
    } catch (const culet::InternalError& error) {
        return complain(
            culet::exit_internal,
            fmt::format("{} (a fault of culet itself: please report it)", error.what()));
    } catch (const std::bad_alloc&) {
        return complain(culet::exit_impossible, "not enough memory for this input");
    } catch (const std::exception& error) {
        return complain(
            culet::exit_internal,
            fmt::format("{} (a fault of culet itself: please report it)", error.what()));
    } catch (...) {
        return complain(culet::exit_internal,
                        "unknown failure (a fault of culet itself: please report it)");
    }
}
