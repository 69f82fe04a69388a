#pragma once
// Measures the engine beams, one parameter at a time about a base case, and beside other renderers:
// speed and error, as tables.

#include <filesystem>
#include <string>

#include "bench/bench_table.h"
#include "bench/frame_time.h"
#include "bench/reference_pictures.h"
#include "render/render.h"
#include "tests/render/bench_scenes.h"

namespace culet {

/// Samples per pixel of the reference that errors are measured against: in the base case, for other
/// renderers, and elsewhere.
constexpr int k_full = 256, k_finest = 1024, k_side = 64;

std::string milliseconds(double seconds);

class BeamBench {
public:
    BeamBench(int pixels, const std::filesystem::path& cache)
        : pixels_(pixels), references_(cache), base_(base_scene(pixels)) {}

    /// Runs one section, or all if `only` is empty. Throws InputError for an unknown one.
    void run(const std::string& only);
    const BenchTables& tables() const { return tables_; }

private:
    // beam_bench.cpp: one parameter at a time.
    void drawing(const std::string& what, const Scene& scene, Drawing drawing, int samples);
    void all_drawings(const std::string& what, const Scene& scene, int samples);
    void reference(int samples);
    void engines();
    void depths();
    void stones();
    void distances();
    void wavelengths();
    void pupils();
    void refractions();
    // beam_figures.cpp
    void relighting();
    void sequences();
    void threads();
    // beam_rivals.cpp: other renderers on the same scenes.
    void plain();
    void equal_error(const Scene& scene, const std::string& of);
    void povray();
    void beside_povray(const std::string& lights, Scene scene);

    void begin(const std::string& name, const std::string& remark);

    int pixels_;
    ReferencePictures references_;
    BenchTables tables_;
    Scene base_;
};

}  // namespace culet
