#pragma once
// A short name for data: equal data have equal names on every machine.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// Two 64-bit FNV-1a hashes (Fowler, Noll, Vo). Not safe against malice.
class Fingerprint {
public:
    void add(std::string_view text);
    void add(double value);
    void add(int value) { add(static_cast<double>(value)); }
    void add(const Vec3& v);
    void add(const std::vector<float>& values);
    void add(const std::vector<double>& values);
    /// Everything that a picture depends on, so not the number of threads.
    void add(const Scene& scene);
    /// Stones, objects and lights, without the view and settings.
    void add_stone_and_light(const Scene& scene);
    void add(const Stone& stone);
    void add(const Solid& solid);
    std::string hex() const;

private:
    void add_bytes(const void* data, std::size_t size);
    std::uint64_t a_ = 0xcbf29ce484222325u, b_ = 0x84222325cbf29ce4u;
};

}  // namespace culet
