#include "render/raytable/relighting.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "render/raytable/air_rays.h"
#include "render/reference/light_field.h"
#include "render/setup/scene_checks.h"
#include "render/work/listener.h"
#include "render/work/threads.h"
#include "stone/errors.h"

namespace culet {

namespace {

// What rows of the picture add up to.
struct RowSums {
    double hit = 0;      // rays
    Rgb stone{};         // over pixels
    double weighed = 0;  // weight of leaves after absorption, over bands
};

// What one thread keeps from row to row: room.
struct RowMemory {
    std::vector<float> stone, air, block, weight;
    std::vector<int> stone_rays;  // of each pixel
    std::vector<int> hit_pixel;   // of each hit; -1: something is nearer than the stone
    std::vector<RaySample> bare_samples;
    AirRays bare;
};

class Relighting {
public:
    Relighting(const RayTable& table, const Scene& scene, const TableRays& rays,
               const Progress& progress, LeafPrecision precision)
        : table_(table),
          scene_(scene),
          rays_(rays),
          colours_(rays.setup.wavelengths_nm),
          surroundings_(surroundings_of(scene, colours_)),
          shader_(leaf_shader(scene, rays, colours_, *surroundings_, table, precision)),
          air_(scene, rays, shader_->middle()),
          width_(scene.camera.width),
          nodes_(colours_.size()),
          samples_(static_cast<int>(table.header().samples)),
          something_near_(any_near()),
          listener_(progress, scene.camera.height) {
        // Colour of a radiance of 1 at each node.
        std::vector<double> one(static_cast<std::size_t>(nodes_), 0.0);
        for (double& node : one) {
            node = 1;
            const Rgb rgb = colours_.rgb_of(one.data());
            node = 0;
            rgb_.push_back({static_cast<float>(rgb[0]), static_cast<float>(rgb[1]),
                            static_cast<float>(rgb[2])});
        }
        start_picture();
    }

    RenderResult draw() {
        const int height = scene_.camera.height;
        std::vector<RowSums> rows(static_cast<std::size_t>(height));
        tbb::enumerable_thread_specific<RowMemory> memories;
        on_threads(scene_.settings.threads, [&] {
            tbb::parallel_for(0, height, [&](int y) {
                if (listener_.goes_on())
                    rows[static_cast<std::size_t>(y)] = draw_row(y, memories.local());
            });
        });
        if (listener_.stopped()) throw Interrupted();
        // In the order of the rows: the same bytes whatever the threads did.
        RowSums whole;
        for (const RowSums& row : rows) {
            whole.hit += row.hit;
            for (std::size_t c = 0; c < 3; ++c) whole.stone[c] += row.stone[c];
            whole.weighed += row.weighed;
        }
        fill_stats(whole);
        return std::move(result_);
    }

private:
    struct Colour {
        float r, g, b;
    };

    // Whether anything may stand before the stone.
    bool any_near() const {
        return std::any_of(scene_.lights.sources.begin(), scene_.lights.sources.end(),
                           [](const Light& light) { return is_near(light); }) ||
               dynamic_cast<const LightField*>(surroundings_.get()) == nullptr;
    }

    void start_picture() {
        Picture& picture = result_.picture;
        picture.width = width_;
        picture.height = scene_.camera.height;
        picture.rgb.resize(3 * picture.pixels());
        picture.coverage.resize(picture.pixels());
        if (!scene_.settings.spectral) return;
        picture.wavelengths_nm = rays_.setup.wavelengths_nm;
        picture.spectral.assign(static_cast<std::size_t>(nodes_),
                                std::vector<float>(picture.pixels()));
    }

    // Hits of the table whose rays belong to rows before `y`.
    std::size_t hits_before(int y) const {
        const auto& rays = table_.parts().hit_ray;
        const std::uint64_t first = static_cast<std::uint64_t>(y) *
                                    static_cast<std::uint64_t>(width_) *
                                    static_cast<std::uint64_t>(samples_);
        return static_cast<std::size_t>(std::lower_bound(rays.begin(), rays.end(), first) -
                                        rays.begin());
    }

    RowSums draw_row(int y, RowMemory& memory) {
        const std::size_t first = hits_before(y), last = hits_before(y + 1);
        const std::size_t values =
            static_cast<std::size_t>(nodes_) * static_cast<std::size_t>(width_);
        memory.stone.assign(values, 0.0f);
        sort_rays(first, last, y, memory);
        RowSums sums;
        for (std::size_t b = 0; b < rays_.setup.bands.size(); ++b)
            sums.weighed += add_leaves(b, first, last, memory);
        memory.air.assign(values, 0.0f);
        if (!memory.bare_samples.empty()) add_air(y, memory);
        put_row(y, memory, sums);
        return sums;
    }

    // What stands before the stone hides it; the reference asks the same.
    bool hidden(std::size_t hit) const {
        if (!something_near_) return false;
        const EyeRay ray = air_.eye_ray(table_.parts().hit_ray[hit]);
        return surroundings_->nearest_distance(ray.origin, ray.direction) <
               static_cast<double>(table_.parts().hit_distance[hit]);
    }

    // Which rays of a row see the stone, and which see past it.
    void sort_rays(std::size_t first, std::size_t last, int y, RowMemory& memory) const {
        memory.stone_rays.assign(static_cast<std::size_t>(width_), 0);
        memory.hit_pixel.assign(last - first, -1);
        memory.bare_samples.clear();
        const auto& rays = table_.parts().hit_ray;
        std::size_t hit = first;
        std::uint32_t ray =
            static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width_ * samples_);
        for (int x = 0; x < width_; ++x) {
            for (int sample = 0; sample < samples_; ++sample, ++ray) {
                const bool meets = hit < last && rays[hit] == ray;
                if (meets && !hidden(hit)) {
                    memory.hit_pixel[hit - first] = x;
                    ++memory.stone_rays[static_cast<std::size_t>(x)];
                } else {
                    memory.bare_samples.push_back({x, sample});
                }
                hit += meets;
            }
        }
    }

    // Constant factors instead of Fresnel's. The first leaf was reflected once; the one behind it
    // was let in and out, and each later one reflected once more in between.
    void use_factors(const std::uint32_t* end, std::size_t hits, std::uint32_t begin,
                     RowMemory& memory) const {
        const RenderSettings& settings = scene_.settings;
        const float R = static_cast<float>(settings.reflection_factor.value_or(1)),
                    T = static_cast<float>(settings.transmission_factor.value_or(1));
        memory.weight.clear();
        for (std::size_t hit = 0; hit < hits; ++hit) {
            float next = T * T;
            const std::uint32_t first = begin + static_cast<std::uint32_t>(memory.weight.size());
            for (std::uint32_t leaf = first; leaf < end[hit]; ++leaf) {
                memory.weight.push_back(leaf == first ? R : next);
                if (leaf != first) next *= R;
            }
        }
    }

    // The leaves from .. to - 1 of the table.
    LeafRun run_of(std::uint32_t from, std::uint32_t to) const {
        const auto& parts = table_.parts();
        LeafRun run;
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

    // Adds what the leaves of a row's hits bring at the nodes of a band; returns their weight.
    double add_leaves(std::size_t number, std::size_t first, std::size_t last,
                      RowMemory& memory) const {
        constexpr std::uint32_t k_block = 512;
        if (first == last) return 0;
        const Band& band = rays_.setup.bands[number];
        const auto& parts = table_.parts();
        const std::size_t in_table = table_.header().bands > 1 ? number : 0;
        const std::uint32_t* end = parts.leaf_end.data() + in_table * table_.header().hits;
        const std::uint32_t begin = end + first == parts.leaf_end.data() ? 0 : *(end + first - 1);
        const bool factors =
            scene_.settings.reflection_factor || scene_.settings.transmission_factor;
        if (factors) use_factors(end + first, last - first, begin, memory);
        double weighed = 0;
        std::uint32_t from = begin;
        // As many whole hits as make a block.
        for (std::size_t hit = first; hit < last;) {
            std::size_t behind = hit + 1;
            while (behind < last && end[behind] - from <= k_block) ++behind;
            const std::uint32_t to = end[behind - 1], stride = to - from;
            if (stride > 0) {
                memory.block.resize(std::max<std::size_t>(
                    memory.block.size(), stride * static_cast<std::size_t>(band.count)));
                LeafRun run = run_of(from, to);
                if (factors) run.weight = memory.weight.data() + (from - begin);
                weighed += band.count * shader_->leaves(number, run, memory.block.data(),
                                                        static_cast<int>(stride));
            }
            const float* seen = memory.block.data();
            std::uint32_t leaf = from;
            for (; hit < behind; ++hit) {
                const std::uint32_t next = end[hit], count = next - leaf;
                const int pixel = memory.hit_pixel[hit - first];
                float* sum =
                    pixel < 0
                        ? nullptr
                        : &memory.stone[static_cast<std::size_t>(pixel * nodes_ + band.first)];
                for (int node = 0; sum != nullptr && node < band.count; ++node) {
                    const float* of = seen + static_cast<std::size_t>(node) * stride;
                    for (std::uint32_t i = 0; i < count; ++i) sum[node] += of[i];
                }
                seen += count;
                leaf = next;
            }
            from = to;
        }
        return weighed;
    }

    void add_air(int y, RowMemory& memory) const {
        air_.make(y, memory.bare_samples, something_near_, memory.bare);
        const std::size_t count = memory.bare_samples.size();
        for (std::size_t b = 0; b < rays_.setup.bands.size(); ++b) {
            const Band& band = rays_.setup.bands[b];
            memory.block.resize(
                std::max(memory.block.size(), count * static_cast<std::size_t>(band.count)));
            shader_->rays(b, memory.bare, memory.block.data(), static_cast<int>(count));
            for (int node = 0; node < band.count; ++node) {
                const float* seen = memory.block.data() + static_cast<std::size_t>(node) * count;
                float* sum = memory.air.data() + band.first + node;
                for (const RaySample& sample : memory.bare_samples) {
                    if (sample.x >= 0) sum[sample.x * nodes_] += *seen;
                    ++seen;
                }
            }
        }
    }

    void put_row(int y, const RowMemory& memory, RowSums& sums) {
        Picture& picture = result_.picture;
        const float share = 1.0f / static_cast<float>(samples_);
        std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
        for (int x = 0; x < width_; ++x, ++pixel) {
            const float* stone = &memory.stone[static_cast<std::size_t>(x * nodes_)];
            const float* air = &memory.air[static_cast<std::size_t>(x * nodes_)];
            const int rays = memory.stone_rays[static_cast<std::size_t>(x)];
            Colour of_stone{}, whole{};
            for (int node = 0; node < nodes_; ++node) {
                const Colour& one = rgb_[static_cast<std::size_t>(node)];
                const float light = share * stone[node], all = light + share * air[node];
                of_stone = {of_stone.r + one.r * light, of_stone.g + one.g * light,
                            of_stone.b + one.b * light};
                whole = {whole.r + one.r * all, whole.g + one.g * all, whole.b + one.b * all};
                if (!picture.spectral.empty())
                    picture.spectral[static_cast<std::size_t>(node)][pixel] = all;
            }
            picture.rgb[3 * pixel] = whole.r;
            picture.rgb[3 * pixel + 1] = whole.g;
            picture.rgb[3 * pixel + 2] = whole.b;
            picture.coverage[pixel] = share * static_cast<float>(rays);
            if (rays == 0) continue;
            sums.hit += rays;
            sums.stone[0] += static_cast<double>(of_stone.r);
            sums.stone[1] += static_cast<double>(of_stone.g);
            sums.stone[2] += static_cast<double>(of_stone.b);
        }
    }

    void fill_stats(const RowSums& whole) {
        RenderStats& stats = result_.stats;
        const RayTableHeader& header = table_.header();
        stats.engine = k_raytable_engine;
        stats.remainder = header.remainder;
        stats.cut = header.cut;
        stats.depth = static_cast<int>(header.deepest);
        stats.rays = static_cast<long long>(header.hits * rays_.setup.bands.size());
        stats.effects.assign(rays_.setup.effects.begin(), rays_.setup.effects.end());
        stats.wavelengths_nm = rays_.setup.wavelengths_nm;
        const double hits = static_cast<double>(header.hits);
        if (rays_.setup.bands.front().absorbs && hits > 0) {
            // What a clear stone's leaves weigh is all that the table did not leave out.
            stats.absorbed = 1 - header.remainder - header.cut - whole.weighed / hits / nodes_;
        }
        if (whole.hit > 0) stats.mean_radiance = luminance(whole.stone) / whole.hit * samples_;
        if (stats.mean_radiance > 0) {
            stats.error_bound =
                (stats.remainder + stats.cut) * surroundings_->max_radiance() / stats.mean_radiance;
        }
    }

    const RayTable& table_;
    const Scene& scene_;
    const TableRays& rays_;
    WavelengthSet colours_;
    std::unique_ptr<const Surroundings> surroundings_;
    std::unique_ptr<const LeafShader> shader_;
    AirRayMaker air_;
    int width_, nodes_, samples_;
    bool something_near_;
    Listener listener_;
    std::vector<Colour> rgb_;
    RenderResult result_;
};

}  // namespace

RenderResult relit(const RayTable& table, const Scene& scene, const TableRays& rays,
                   const Progress& progress, LeafPrecision precision) {
    return Relighting(table, scene, rays, progress, precision).draw();
}

}  // namespace culet
