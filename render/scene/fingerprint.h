#pragma once
// A short name for a lot of data: equal data, equal name, on every machine.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// FNV-1a (Fowler, Noll, Vo), two of 64 bits from different starts. Not against malice.
class Fingerprint {
public:
    void add(std::string_view text);
    void add(double value);
    void add(int value) { add(static_cast<double>(value)); }
    void add(const Vec3& v);
    void add(const std::vector<float>& values);
    void add(const std::vector<double>& values);
    /// Everything that a picture of the scene depends on, threads apart.
    void add(const Scene& scene);
    /// The same but for the view and the settings: stones, objects and lights.
    void add_stone_and_light(const Scene& scene);
    void add(const Stone& stone);
    void add(const Solid& solid);
    std::string hex() const;

private:
    void add_bytes(const void* data, std::size_t size);
    std::uint64_t a_ = 0xcbf29ce484222325u, b_ = 0x84222325cbf29ce4u;
};

}  // namespace culet
