#include "render/raytable/row_light.h"

#include <algorithm>

namespace culet {

RowLight::RowLight(const RayTable& table, const Scene& scene, const TableRays& rays,
                   const ExitShader& shader, bool origins)
    : table_(table),
      settings_(scene.settings),
      rays_(rays),
      shader_(shader),
      air_(scene, rays, shader.middle()),
      width_(scene.camera.width),
      origins_(origins) {}

// Replaces Fresnel's factors by constants. The first exit event was reflected once; the next was
// transmitted twice, and each later one reflected once more in between.
void RowLight::use_factors(const std::uint32_t* end, std::size_t hits, std::uint32_t begin,
                           RowMemory& memory) const {
    const RenderSettings& settings = settings_;
    const float R = static_cast<float>(settings.reflection_factor.value_or(1)),
                T = static_cast<float>(settings.transmission_factor.value_or(1));
    memory.weight.clear();
    for (std::size_t hit = 0; hit < hits; ++hit) {
        float next = T * T;
        const std::uint32_t first = begin + static_cast<std::uint32_t>(memory.weight.size());
        for (std::uint32_t exit_event = first; exit_event < end[hit]; ++exit_event) {
            memory.weight.push_back(exit_event == first ? R : next);
            if (exit_event != first) next *= R;
        }
    }
}

// Exit events from .. to - 1 of the table.
ExitRun RowLight::run_of(std::uint32_t from, std::uint32_t to) const {
    const auto& parts = table_.parts();
    ExitRun run;
    run.weight = &parts.weight[from];
    for (std::size_t k = 0; k < 2; ++k) {
        run.direction[k] = &parts.direction[k][from];
        run.point[k] = &parts.point[k][from];
    }
    run.facet = &parts.facet[from];
    for (std::uint32_t k = 0; k < table_.header().lengths; ++k)
        run.length[k] = &parts.length[k][from];
    run.count = static_cast<int>(to - from);
    return run;
}

double RowLight::add_exits(std::size_t number, std::size_t first, std::size_t last,
                           RowMemory& memory) const {
    constexpr std::uint32_t k_block = 512;
    if (first == last) return 0;
    const Band& band = rays_.setup.bands[number];
    const auto& parts = table_.parts();
    const std::size_t in_table = table_.header().bands > 1 ? number : 0;
    const std::uint32_t* end = parts.exits_end.data() + in_table * table_.header().hits;
    const std::uint32_t begin = end + first == parts.exits_end.data() ? 0 : *(end + first - 1);
    const bool factors = settings_.reflection_factor || settings_.transmission_factor;
    if (factors) use_factors(end + first, last - first, begin, memory);
    double weighed = 0;
    std::uint32_t from = begin;
    // Take as many whole hits as fit into a block.
    for (std::size_t hit = first; hit < last;) {
        std::size_t behind = hit + 1;
        while (behind < last && end[behind] - from <= k_block) ++behind;
        const std::uint32_t to = end[behind - 1], stride = to - from;
        if (stride > 0) {
            memory.block.resize(std::max<std::size_t>(
                memory.block.size(), stride * static_cast<std::size_t>(band.count)));
            ExitRun run = run_of(from, to);
            if (factors) run.weight = memory.weight.data() + (from - begin);
            weighed += band.count *
                       shader_.exits(number, run, memory.block.data(), static_cast<int>(stride));
        }
        const float* seen = memory.block.data();
        std::uint32_t exit_event = from;
        for (; hit < behind; ++hit) {
            const std::uint32_t next = end[hit], count = next - exit_event;
            const int pixel = memory.hit_pixel[hit - first];
            float* sum = memory.stone.data() + band.first * width_ + pixel;
            for (int node = 0; pixel >= 0 && node < band.count; ++node, sum += width_) {
                const float* of = seen + static_cast<std::size_t>(node) * stride;
                for (std::uint32_t i = 0; i < count; ++i) *sum += of[i];
            }
            seen += count;
            exit_event = next;
        }
        from = to;
    }
    return weighed;
}

void RowLight::add_air(int y, RowMemory& memory) const {
    air_.make(y, memory.bare_samples, origins_, memory.bare);
    const std::size_t count = memory.bare_samples.size();
    for (std::size_t b = 0; b < rays_.setup.bands.size(); ++b) {
        const Band& band = rays_.setup.bands[b];
        memory.block.resize(
            std::max(memory.block.size(), count * static_cast<std::size_t>(band.count)));
        shader_.rays(b, memory.bare, memory.block.data(), static_cast<int>(count));
        for (int node = 0; node < band.count; ++node) {
            const float* seen = memory.block.data() + static_cast<std::size_t>(node) * count;
            float* sum = memory.air.data() + (band.first + node) * width_;
            for (const RaySample& sample : memory.bare_samples) {
                if (sample.x >= 0) sum[sample.x] += *seen;
                ++seen;
            }
        }
    }
}

}  // namespace culet
