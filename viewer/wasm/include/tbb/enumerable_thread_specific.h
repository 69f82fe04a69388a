#pragma once
// See parallel_for.h: with one thread there is one value.

#include <functional>
#include <optional>
#include <utility>

namespace tbb {

template <class T>
class enumerable_thread_specific {
public:
    enumerable_thread_specific() : make_([] { return T(); }) {}
    template <class Make>
    explicit enumerable_thread_specific(Make make) : make_(std::move(make)) {}

    T& local() {
        if (!value_) value_.emplace(make_());
        return *value_;
    }
    T* begin() { return value_ ? &*value_ : nullptr; }
    T* end() { return begin() + (value_ ? 1 : 0); }

private:
    std::function<T()> make_;
    std::optional<T> value_;
};

}  // namespace tbb
