// Times the viewer's engine in the program, on one thread: milliseconds of the pictures that
// viewer_bench.py times in a browser, as JSON. Usage: bench_viewer REPEATS

#include <fmt/format.h>

#include <tbb/global_control.h>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/viewer_bench_cases.h"
#include "viewer/engine/viewer_engine.h"

int main(int count, char** words) {
    using namespace culet;
    using Json = nlohmann::ordered_json;
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const int repeats = count > 1 ? std::atoi(words[1]) : 20;
    Json all = Json::array();
    for (const ViewerBenchCase& one : viewer_bench_cases()) {
        ViewerEngine engine("bench");
        engine.answer("open", "{}", one.document);
        engine.answer("set", one.set);
        std::vector<double> ms;
        for (int i = 0; i <= repeats; ++i) {
            const Json answer = Json::parse(engine.answer("draw", one.draw(i)));
            if (i > 0) ms.push_back(answer.at("milliseconds"));  // the first grows its memory
        }
        std::sort(ms.begin(), ms.end());
        Json draws = Json::array();
        for (int i = 0; i <= repeats; ++i) draws.push_back(Json::parse(one.draw(i)));
        all.push_back({{"name", one.name},
                       {"document", Json::parse(one.document)},
                       {"set", Json::parse(one.set)},
                       {"draws", draws},
                       {"median_ms", ms[ms.size() / 2]},
                       {"least_ms", ms.front()}});
    }
    fmt::print("{}\n", all.dump());
    return 0;
}
