// culet COMMAND INPUT... [options]: parses, calls, writes; the only place where errors are caught.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>

#include "app/program/options.h"
#include "app/program/terminal.h"
#include "app/program/usage_advice.h"
#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"

namespace {

int complain(int code, const std::string& message) {
    const bool colour = isatty(STDERR_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr;
    fmt::print(stderr, "{}culet: error:{} {}\n", colour ? "\033[1;31m" : "",
               colour ? "\033[0m" : "", culet::safe_for(stderr, message));
    return code;
}

// Distinguishes a file in the command's place from a misspelt command.
std::string unknown_command(const std::string& word, const std::vector<std::string>& commands) {
    const bool is_file = word.find('.') != std::string::npos;
    if (is_file) {
        return fmt::format(
            "\"{0}\" stands where a command belongs: culet info {0} says what it "
            "holds, culet --help lists the commands",
            word);
    }
    const std::vector<std::string> like = culet::names_like(word, commands);
    return fmt::format("no command \"{}\"{} (see culet --help)", word,
                       like.empty() ? "" : fmt::format(", did you mean {}?", culet::listed(like)));
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
        "Exit codes: 0 good, 1 done but not to be trusted, 2 could not be done, 3 an error in "
        "culet, 130 interrupted.");
    int exit_code = exit_good;
    add_command_fit(program, exit_code);
    add_command_render(program, exit_code);
    add_command_view(program, exit_code);
    add_command_studio(program, exit_code);
    add_command_register(program, exit_code);
    add_command_compare(program, exit_code);
    add_command_photo(program, exit_code);
    add_command_outline(program, exit_code);
    add_command_spin(program, exit_code);
    add_command_refine(program, exit_code);
    add_command_light(program, exit_code);
    add_command_camera(program, exit_code);
    add_command_run(program, exit_code);
    add_command_study(program, exit_code);
    add_command_grade(program, exit_code);
    add_command_optimize(program, exit_code);
    add_command_batch(program, exit_code);
    add_command_probe(program, exit_code);
    add_command_cut(program, exit_code);
    add_command_setting(program, exit_code);
    add_command_convert(program, exit_code);
    add_command_info(program, exit_code);
    add_command_help(program, exit_code);
    std::vector<std::string> commands;
    for (const CLI::App* command : program.get_subcommands({})) {
        commands.push_back(command->get_name());
    }
    const bool names_a_command = argc > 1 && argv[1][0] != '-';
    if (names_a_command && std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
        return complain(exit_impossible, unknown_command(argv[1], commands));
    }
    if (argc == 1) {
        fmt::print(stderr, "{}", first_commands());
        return exit_impossible;
    }
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
        return complain(exit_impossible, usage_advice(program, {argv + 1, argv + argc}, error));
    }
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    culet::catch_interrupts();
    // Exceeding the limit on file size then fails as a write error with a message, instead of
    // killing the program.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        const int exit_code = run(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            return complain(culet::exit_impossible,
                            "standard output could not be written: is the disk full?");
        return exit_code;
    } catch (const culet::InputError& error) {
        return complain(culet::exit_impossible, error.what());
    } catch (const culet::Interrupted&) {
        return complain(culet::exit_interrupted, "interrupted; nothing was written");
    } catch (const culet::InternalError& error) {
        return complain(
            culet::exit_internal,
            fmt::format("{} (an error in culet itself: please report it)", error.what()));
    } catch (const std::system_error& error) {
        return complain(culet::exit_impossible,
                        fmt::format("the system refused: {}", error.what()));
    } catch (const std::bad_alloc&) {
        return complain(culet::exit_impossible, "not enough memory for this input");
    } catch (const std::exception& error) {
        return complain(
            culet::exit_internal,
            fmt::format("{} (an error in culet itself: please report it)", error.what()));
    } catch (...) {
        return complain(culet::exit_internal,
                        "unknown failure (an error in culet itself: please report it)");
    }
}
