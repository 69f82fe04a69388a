// make_stability_page RESULTS PAGE: writes the page of the results that hard_tests left in RESULTS,
// and verdicts.txt beside it.

#include <cstdio>
#include <exception>
#include <filesystem>

#include "stone/text/output_file.h"
#include "tests/hard/stability_page.h"

int main(int argc, char** argv) {
    using namespace culet;
    if (argc != 3) {
        std::fprintf(stderr, "usage: make_stability_page RESULTS PAGE\n");
        return 2;
    }
    try {
        const std::filesystem::path folder = argv[1], page = argv[2];
        const auto corpus = hard::read_corpus(CULET_SOURCE_DIR "/tests/hard");
        std::vector<std::string> results;
        std::size_t run = 0;
        for (const hard::HardCase& one : corpus) {
            const auto file = folder / (one.section + "." + one.name + ".json");
            results.push_back(std::filesystem::exists(file) ? read_text(file) : "");
            run += !results.back().empty();
        }
        std::filesystem::create_directories(page.parent_path());
        write_text(page, hard::stability_page(corpus, results));
        write_text(folder / "verdicts.txt", hard::verdicts(results));
        std::printf("%zu of %zu cases: %s\n", run, corpus.size(), page.c_str());
        return run > 0 ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
