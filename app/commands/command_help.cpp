// culet help [WORD]: the help of a command, and of the JSON files that culet writes.

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/program/options.h"
#include "app/program/terminal.h"
#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"
#include "stone/text/output_file.h"

namespace culet {

namespace embedded {
extern const char* const json_schemas;
}

namespace {

using Json = nlohmann::ordered_json;

struct HelpArguments {
    std::string word, schema;
};

// "urn:culet:NAME:VERSION"
std::string name_of_schema(const Json& schema) {
    const std::string id = schema.at("$id").get<std::string>();
    const std::size_t begin = id.find(':', 4) + 1;
    return id.substr(begin, id.rfind(':') - begin);
}

void list_schemas(const Json& schemas) {
    print_lines(
        "The JSON that culet writes; `culet help json NAME` prints its schema (JSON Schema "
        "2020-12).\nKeys may be added; where one is renamed, removed or means something else, the "
        "number `schema` grows.\n\n");
    for (const Json& schema : schemas)
        print_lines(fmt::format("  {:<18} {}\n  {:<18} {}\n", name_of_schema(schema),
                                schema["title"].get<std::string>(), "",
                                schema["$comment"].get<std::string>()));
}

void print_schema(const Json& schemas, const std::string& name) {
    std::vector<std::string> names;
    for (const Json& schema : schemas) {
        names.push_back(name_of_schema(schema));
        if (names.back() == name) return write_text("-", schema.dump(1) + "\n");
    }
    const std::vector<std::string> like = names_like(name, names);
    throw InputError(fmt::format("no JSON \"{}\"{} (see culet help json)", name,
                                 like.empty() ? "" : ", did you mean " + listed(like) + "?"));
}

std::string help_of(const CLI::App& command, const std::string& name) {
    return command.get_formatter()->make_help(&command, name, CLI::AppFormatMode::Normal);
}

std::string help_of_command(const CLI::App& program, const std::string& word) {
    for (const CLI::App* one : program.get_subcommands({})) {
        if (one->check_name(word)) return help_of(*one, "culet " + word);
    }
    throw InputError(fmt::format(
        "no command \"{}\": culet --help lists them, culet help json the JSON files", word));
}

int run_help(const HelpArguments& a, const CLI::App& program) {
    if (a.word != "json") {
        write_text("-",
                   a.word.empty() ? help_of(program, "culet") : help_of_command(program, a.word));
    } else if (const Json schemas = Json::parse(embedded::json_schemas); a.schema.empty()) {
        list_schemas(schemas);
    } else {
        print_schema(schemas, a.schema);
    }
    return exit_good;
}

}  // namespace

void add_command_help(CLI::App& program, int& exit_code) {
    auto a = std::make_shared<HelpArguments>();
    CLI::App* command =
        program.add_subcommand("help", "help of a command; the JSON files and their schemas");
    command->add_option("WORD", a->word, "a command, or json");
    command->add_option("NAME", a->schema, "after json: print this schema");
    command->footer(
        "Examples:\n"
        "  culet help json\n"
        "  culet help json fit");
    command->callback([a, &program, &exit_code] { exit_code = run_help(*a, program); });
}

}  // namespace culet
