#pragma once
// Arrays of many megabytes.

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace fascicle {

/// Memory for `bytes` bytes, not set to anything; large amounts begin at a large page and ask the system for such,
/// which makes scattered access and first use cheaper. Throws std::bad_alloc.
void* allocate_large(std::size_t bytes);
void free_large(void* memory, std::size_t bytes) noexcept;

/// For numbers only: resize() leaves new elements unset, so that they can be written first by the thread that
/// uses them.
template <typename T>
struct LargeAllocator {
    static_assert(std::is_trivially_copyable_v<T>);
    using value_type = T;
    LargeAllocator() = default;
    template <typename U>
    LargeAllocator(const LargeAllocator<U>&) {}
    T* allocate(std::size_t n) { return static_cast<T*>(allocate_large(n * sizeof(T))); }
    void deallocate(T* memory, std::size_t n) noexcept { free_large(memory, n * sizeof(T)); }
    template <typename U>
    void construct(U* place) {
        ::new (static_cast<void*>(place)) U;
    }
    template <typename U, typename... Args>
    void construct(U* place, Args&&... args) {
        ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
    }
    friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

template <typename T>
using LargeArray = std::vector<T, LargeAllocator<T>>;

} // namespace fascicle
