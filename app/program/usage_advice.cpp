#include "app/program/usage_advice.h"

#include <fmt/format.h>

#include <algorithm>

#include "stone/text/name_suggestions.h"
#include "stone/text/toml_advice.h"

namespace culet {

namespace {

// The command, and its subcommand, that the words name.
const CLI::App* command_of(const CLI::App& program, const std::vector<std::string>& words,
                           std::string& name) {
    const CLI::App* command = &program;
    for (const std::string& word : words) {
        if (word.starts_with('-')) break;
        const CLI::App* next = nullptr;
        for (const CLI::App* one : command->get_subcommands({})) {
            if (one->check_name(word)) next = one;
        }
        if (next == nullptr) break;
        command = next;
        name += " " + word;
    }
    return command;
}

std::vector<std::string> long_options(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

// Empty: every word that looks like a long option belongs to the command.
std::string unknown_option(const CLI::App& command, const std::string& name,
                           const std::vector<std::string>& words) {
    const std::vector<std::string> known = long_options(command);
    for (const std::string& word : words) {
        if (word == "--") break;
        if (!word.starts_with("--") || word.size() < 3) continue;
        const std::string option = word.substr(0, word.find('='));
        if (std::find(known.begin(), known.end(), option) != known.end()) continue;
        const std::vector<std::string> like = names_like(option, known);
        return fmt::format("{} has no option \"{}\"{} (see {} --help)", name, option,
                           like.empty() ? "" : fmt::format(", did you mean {}?", listed(like, 3)),
                           name);
    }
    return {};
}

}  // namespace

std::string usage_advice(const CLI::App& program, const std::vector<std::string>& words,
                         const CLI::ParseError& error) {
    std::string name = "culet";
    const CLI::App* command = command_of(program, words, name);
    if (std::string unknown = unknown_option(*command, name, words); !unknown.empty())
        return unknown;
    std::string message = error.what();
    if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr ||
        dynamic_cast<const CLI::ValidationError*>(&error) != nullptr) {
        for (const std::string& word : words) {
            // The value as written: messages quote it in various ways.
            const std::string value = word.substr(word.find('=') + 1);
            if (message.find(value) == std::string::npos) continue;
            if (const std::string advice = number_advice(value); !advice.empty()) {
                message += ": " + advice;
                break;
            }
        }
    }
    return fmt::format("{} (see {} --help)", message, name);
}

std::string first_commands() {
    return "culet fits a hand-made gem model to its measurements, renders it with polarised light\n"
           "and compares the picture with a photograph. To begin with:\n"
           "  culet cut round-brilliant -o brilliant.obj   a stone to start from\n"
           "  culet info brilliant.obj                     what a file holds, and what is wrong\n"
           "  culet info --materials garnet                what stones can be made of\n"
           "  culet fit stone.toml -o fitted.obj           the stone that the readings say\n"
           "  culet render scene.toml -o picture.png       what one would see\n"
           "culet --help lists all commands, culet COMMAND --help explains one.\n";
}

}  // namespace culet
