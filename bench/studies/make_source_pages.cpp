// make_source_pages [NAME ...] [-o FOLDER] [--set KEY=VALUE ...]: the pages on culet's sources.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "bench/studies/source_studies.h"
#include "stone/text/output_file.h"
#include "tests/cpu_time.h"

int main(int argc, char** argv) {
    using namespace culet;
    CLI::App app{"Writes a page for each of culet's sources: its figures beside culet's."};
    std::vector<std::string> names, overrides;
    std::string folder = CULET_SOURCE_DIR "/docs/sources";
    std::vector<std::string> known;
    for (const SourceStudy& study : source_studies()) known.push_back(study.name);
    app.add_option("NAME,--source", names, "these sources only")->check(CLI::IsMember(known));
    app.add_option("-o,--output", folder, "folder of the pages")->capture_default_str();
    app.add_option("--set", overrides, "guy-soler.tree_depth=12: another parameter");
    CLI11_PARSE(app, argc, argv);
    try {
        const TomlTable all =
            read_toml(CULET_SOURCE_DIR "/bench/studies/parameters.toml", overrides);
        std::filesystem::create_directories(folder);
        for (const SourceStudy& study : source_studies()) {
            if (!names.empty() && std::find(names.begin(), names.end(), study.name) == names.end())
                continue;
            const auto table = all.table(study.name);
            if (!table) all.fail(study.name, "is missing: the parameters of that study");
            const Clocks start = clocks();
            Parameters parameters(*table);
            const SourcePage page = study.make(parameters);
            const auto file = std::filesystem::path(folder) / (page.name() + ".html");
            write_text(file, page.html(parameters.used()));
            std::printf("%s: %.0f s\n", file.c_str(), clocks().wall - start.wall);
            std::fflush(stdout);
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_source_pages: %s\n", error.what());
        return 1;
    }
}
