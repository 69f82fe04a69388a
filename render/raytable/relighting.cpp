#include "render/raytable/relighting.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <numeric>

#include "render/raytable/row_light.h"
#include "render/reference/light_field.h"
#include "render/setup/scene_checks.h"
#include "render/work/listener.h"
#include "render/work/threads.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

struct RowSums {
    double hit = 0;      // rays
    Rgb stone{};         // over rays
    double weighed = 0;  // weight of exit events after absorption, over bands
};

class Relighting {
public:
    Relighting(const RayTable& table, const Scene& scene, const TableRays& rays,
               const Progress& progress, ExitPrecision precision)
        : table_(table),
          scene_(scene),
          rays_(rays),
          colours_(rays.setup.colours()),
          surroundings_(surroundings_of(scene, colours_)),
          shader_(exit_shader(scene, rays, colours_, *surroundings_, table, precision)),
          width_(scene.camera.width),
          nodes_(colours_.size()),
          samples_(static_cast<int>(table.header().samples)),
          something_near_(any_near()),
          light_(table, scene, rays, *shader_, something_near_),
          listener_(progress, scene.camera.height) {
        // Colour of radiance 1 at each node.
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
        // In row order, so that the bytes do not depend on the threads.
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

    // Whether anything may stand in front of the stone.
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
            sums.weighed += light_.add_exits(b, first, last, memory);
        memory.air.assign(values, 0.0f);
        if (!memory.bare_samples.empty()) light_.add_air(y, memory);
        put_row(y, memory, sums);
        return sums;
    }

    // Sorts a row's rays into those that see the stone and those that see past it.
    void sort_rays(std::size_t first, std::size_t last, int y, RowMemory& memory) const {
        memory.stone_rays.assign(static_cast<std::size_t>(width_), 0);
        memory.hit_pixel.assign(last - first, -1);
        memory.bare_samples.resize(static_cast<std::size_t>(width_ * samples_));
        const std::uint32_t begin =
            static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width_ * samples_);
        const std::uint32_t* rays = table_.parts().hit_ray.data();
        memory.hit_samples.clear();
        RaySample *bare = memory.bare_samples.data(), next{0, 0};
        const auto step = [this, &next] {
            if (++next.sample < samples_) return;
            next.sample = 0;
            ++next.x;
        };
        std::uint32_t ray = begin;
        for (std::size_t hit = first; hit < last; ++hit, ++ray, step()) {
            for (; ray < rays[hit]; ++ray, step()) *bare++ = next;
            memory.hit_pixel[hit - first] = next.x;
            ++memory.stone_rays[static_cast<std::size_t>(next.x)];
            if (something_near_) memory.hit_samples.push_back(next);
        }
        for (; next.x < width_; step()) *bare++ = next;
        memory.bare_samples.resize(static_cast<std::size_t>(bare - memory.bare_samples.data()));
        if (something_near_) hide(first, y, memory);
    }

    // Rays blocked by something in front of the stone count as rays past it.
    void hide(std::size_t first, int y, RowMemory& memory) const {
        std::vector<RaySample>& samples = memory.hit_samples;
        light_.air().make(y, samples, true, memory.bare);
        memory.block.resize(std::max(memory.block.size(), samples.size()));
        shader_->nearest(memory.bare, memory.block.data());
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (!(memory.block[i] < table_.parts().hit_distance[first + i])) continue;
            memory.hit_pixel[i] = -1;
            --memory.stone_rays[static_cast<std::size_t>(samples[i].x)];
            memory.bare_samples.push_back(samples[i]);
        }
    }

    // Adds the stone's and the air's light of a row to the picture.
    void put_row(int y, RowMemory& memory, RowSums& sums) {
        Picture& picture = result_.picture;
        const float share = 1.0f / static_cast<float>(samples_);
        const auto width = static_cast<std::size_t>(width_);
        const std::size_t first = static_cast<std::size_t>(y) * width;
        memory.colour.assign(3 * width, 0.0f);
        float *r = memory.colour.data(), *g = r + width, *b = g + width;
        for (std::size_t node = 0; node < static_cast<std::size_t>(nodes_); ++node) {
            float* light = memory.stone.data() + node * width;
            const float* air = memory.air.data() + node * width;
            const Colour one = rgb_[node];
            const double stone = static_cast<double>(std::reduce(light, light + width, 0.0f));
            sums.stone[0] += static_cast<double>(one.r) * stone;
            sums.stone[1] += static_cast<double>(one.g) * stone;
            sums.stone[2] += static_cast<double>(one.b) * stone;
            for (std::size_t x = 0; x < width; ++x) {
                const float all = share * (light[x] + air[x]);
                light[x] = all;
                r[x] += one.r * all;
                g[x] += one.g * all;
                b[x] += one.b * all;
            }
            if (!picture.spectral.empty())
                std::copy_n(light, width, picture.spectral[node].data() + first);
        }
        float* rgb = picture.rgb.data() + 3 * first;
        for (std::size_t x = 0; x < width; ++x) {
            rgb[3 * x] = r[x];
            rgb[3 * x + 1] = g[x];
            rgb[3 * x + 2] = b[x];
        }
        const int* rays = memory.stone_rays.data();
        for (std::size_t x = 0; x < width; ++x)
            picture.coverage[first + x] = share * static_cast<float>(rays[x]);
        sums.hit = std::reduce(rays, rays + width);
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
            // A clear stone's exit events carry all that the table did not leave out.
            stats.absorbed = 1 - header.remainder - header.cut - whole.weighed / hits / nodes_;
        }
        if (whole.hit > 0) stats.mean_radiance = luminance(whole.stone) / whole.hit;
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
    std::unique_ptr<const ExitShader> shader_;
    int width_, nodes_, samples_;
    bool something_near_;
    RowLight light_;
    Listener listener_;
    std::vector<Colour> rgb_;
    RenderResult result_;
};

}  // namespace

RenderResult relit(const RayTable& table, const Scene& scene, const TableRays& rays,
                   const Progress& progress, ExitPrecision precision) {
    return Relighting(table, scene, rays, progress, precision).draw();
}

}  // namespace culet
