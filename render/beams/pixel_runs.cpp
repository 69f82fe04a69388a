#include "render/beams/pixel_runs.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/beams/pixel_runs.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h; clang-format must not sort them.
#include "render/beams/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

// Calls `whole(i)` for full vectors. For the rest calls `part(i, mask)` if the processor has masked
// stores, else `one(i)` for each value.
template <typename Whole, typename Part, typename One>
HWY_INLINE void over_values(int count, const Whole& whole, const Part& part, const One& one) {
    const int lanes = static_cast<int>(hn::Lanes(k_floats));
    int i = 0;
    for (; i + lanes <= count; i += lanes) whole(i);
    if (i == count) return;
#if HWY_TARGET <= HWY_AVX2
    (void)one;
    part(i, hn::FirstN(k_floats, static_cast<size_t>(count - i)));
#else
    (void)part;
    for (; i < count; ++i) one(i);
#endif
}

template <bool kValues>
void add_to(const PixelRuns& runs, const float* values, const float* shares, float factor,
            const PixelRows& rows) {
    const V by = number(factor);
    for (const PixelRun& run : runs) {
        float* to = rows.values + (run.pixel - rows.first_pixel);
        const float *share = shares + run.first, *value = kValues ? values + run.first : nullptr;
        over_values(
            run.count,
            [&](int i) HWY_ATTR {
                V more = by * hn::LoadU(k_floats, share + i);
                if constexpr (kValues) more = more * hn::LoadU(k_floats, value + i);
                hn::StoreU(hn::LoadU(k_floats, to + i) + more, k_floats, to + i);
            },
            [&](int i, M mask) HWY_ATTR {
                V more = by * hn::MaskedLoad(mask, k_floats, share + i);
                if constexpr (kValues) more = more * hn::MaskedLoad(mask, k_floats, value + i);
                hn::BlendedStore(hn::MaskedLoad(mask, k_floats, to + i) + more, mask, k_floats,
                                 to + i);
            },
            [&](int i) {
                float more = factor * share[i];
                if constexpr (kValues) more *= value[i];
                to[i] += more;
            });
    }
}

void AddToRuns(const PixelRuns& runs, const float* values, const float* shares, float factor,
               const PixelRows& to) {
    if (values != nullptr) {
        add_to<true>(runs, values, shares, factor, to);
    } else {
        add_to<false>(runs, values, shares, factor, to);
    }
}

void ClaimRuns(const PixelRuns& runs, const PixelRows& taken, float* shares) {
    const V one = number(1.0f);
    for (const PixelRun& run : runs) {
        float *share = shares + run.first, *mark = taken.values + (run.pixel - taken.first_pixel);
        over_values(
            run.count,
            [&](int i) HWY_ATTR {
                const V free = one - hn::LoadU(k_floats, mark + i);
                hn::StoreU(free * hn::LoadU(k_floats, share + i), k_floats, share + i);
                hn::StoreU(one, k_floats, mark + i);
            },
            [&](int i, M mask) HWY_ATTR {
                const V free = one - hn::MaskedLoad(mask, k_floats, mark + i);
                hn::BlendedStore(free * hn::MaskedLoad(mask, k_floats, share + i), mask, k_floats,
                                 share + i);
                hn::BlendedStore(one, mask, k_floats, mark + i);
            },
            [&](int i) {
                share[i] *= 1 - mark[i];
                mark[i] = 1;
            });
    }
}

float SumOfShared(const float* values, const float* shares, int count) {
    V sum = number(0.0f);
    float rest = 0;
    const auto product = [&](int i, const auto& load) HWY_ATTR {
        return values != nullptr ? load(shares + i) * load(values + i) : load(shares + i);
    };
    over_values(
        count,
        [&](int i) HWY_ATTR {
            sum = sum + product(i, [](const float* p) HWY_ATTR { return hn::LoadU(k_floats, p); });
        },
        [&](int i, M mask) HWY_ATTR {
            sum = sum + product(i, [&](const float* p)
                                       HWY_ATTR { return hn::MaskedLoad(mask, k_floats, p); });
        },
        [&](int i) { rest += product(i, [](const float* p) { return *p; }); });
    return hn::GetLane(hn::SumOfLanes(k_floats, sum)) + rest;
}

bool AnyUnmarkedWhole(const float* marks, const float* shares, int count) {
    M any = hn::FirstN(k_floats, 0);
    bool rest = false;
    const V one = number(1.0f), half = number(0.5f);
    over_values(
        count,
        [&](int i) HWY_ATTR {
            any = hn::Or(any, hn::And(hn::LoadU(k_floats, shares + i) >= one,
                                      hn::LoadU(k_floats, marks + i) < half));
        },
        [&](int i, M mask) HWY_ATTR {
            any = hn::Or(any, hn::And(hn::MaskedLoad(mask, k_floats, shares + i) >= one,
                                      hn::MaskedLoad(mask, k_floats, marks + i) < half));
        },
        [&](int i) { rest = rest || (shares[i] >= 1 && marks[i] < 0.5f); });
    return rest || !hn::AllFalse(k_floats, any);
}

void FindGaps(const PixelRows& rows, int width, int count, std::vector<int>& pixels) {
    const int lanes = static_cast<int>(hn::Lanes(k_floats));
    const V zero = number(0.0f);
    for (int y = 0; y < count; ++y) {
        const float *here = rows.values + static_cast<std::ptrdiff_t>(y) * width,
                    *above = y > 0 ? here - width : here,
                    *below = y + 1 < count ? here + width : here;
        const auto gap = [&](int x) {
            return here[x] == 0 &&
                   ((x > 0 && here[x - 1] != 0) || (x + 1 < width && here[x + 1] != 0) ||
                    above[x] != 0 || below[x] != 0);
        };
        const auto look = [&](int from, int until) {
            for (int x = from; x < until; ++x) {
                if (gap(x)) pixels.push_back(rows.first_pixel + y * width + x);
            }
        };
        look(0, std::min(1, width));
        int x = 1;
        for (; x + lanes < width; x += lanes) {
            const V beside = hn::LoadU(k_floats, here + x - 1) + hn::LoadU(k_floats, here + x + 1) +
                             hn::LoadU(k_floats, above + x) + hn::LoadU(k_floats, below + x);
            const M any = hn::And(hn::LoadU(k_floats, here + x) == zero, beside != zero);
            if (!hn::AllFalse(k_floats, any)) look(x, x + lanes);
        }
        look(x, width);
    }
}

void AddUpToOne(const float* values, int count, float factor, float* to) {
    const V by = number(factor), one = number(1.0f);
    over_values(
        count,
        [&](int i) HWY_ATTR {
            hn::StoreU(hn::MulAdd(by, hn::Min(hn::LoadU(k_floats, values + i), one),
                                  hn::LoadU(k_floats, to + i)),
                       k_floats, to + i);
        },
        [&](int i, M mask) HWY_ATTR {
            hn::BlendedStore(
                hn::MulAdd(by, hn::Min(hn::MaskedLoad(mask, k_floats, values + i), one),
                           hn::MaskedLoad(mask, k_floats, to + i)),
                mask, k_floats, to + i);
        },
        [&](int i) { to[i] += factor * std::min(values[i], 1.0f); });
}

void SpreadToRgb(const float* values, std::size_t count, float* rgb) {
    const std::size_t lanes = hn::Lanes(k_floats);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        const V v = hn::LoadU(k_floats, values + i);
        hn::StoreInterleaved3(v, v, v, k_floats, rgb + 3 * i);
    }
    for (; i < count; ++i) rgb[3 * i] = rgb[3 * i + 1] = rgb[3 * i + 2] = values[i];
}

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace culet {

HWY_EXPORT(AddToRuns);
HWY_EXPORT(ClaimRuns);
HWY_EXPORT(SumOfShared);
HWY_EXPORT(AnyUnmarkedWhole);
HWY_EXPORT(FindGaps);
HWY_EXPORT(AddUpToOne);
HWY_EXPORT(SpreadToRgb);

void add_to_runs(const PixelRuns& runs, const float* values, const float* shares, float factor,
                 const PixelRows& to) {
    HWY_DYNAMIC_DISPATCH(AddToRuns)(runs, values, shares, factor, to);
}
void claim_runs(const PixelRuns& runs, const PixelRows& taken, float* shares) {
    HWY_DYNAMIC_DISPATCH(ClaimRuns)(runs, taken, shares);
}
float sum_of_shared(const float* values, const float* shares, int count) {
    return HWY_DYNAMIC_DISPATCH(SumOfShared)(values, shares, count);
}
bool any_unmarked_whole(const float* marks, const float* shares, int count) {
    return HWY_DYNAMIC_DISPATCH(AnyUnmarkedWhole)(marks, shares, count);
}
void find_gaps(const PixelRows& rows, int width, int count, std::vector<int>& pixels) {
    HWY_DYNAMIC_DISPATCH(FindGaps)(rows, width, count, pixels);
}
void add_up_to_one(const float* values, int count, float factor, float* to) {
    HWY_DYNAMIC_DISPATCH(AddUpToOne)(values, count, factor, to);
}
void spread_to_rgb(const float* values, std::size_t count, float* rgb) {
    HWY_DYNAMIC_DISPATCH(SpreadToRgb)(values, count, rgb);
}

}  // namespace culet
#endif
