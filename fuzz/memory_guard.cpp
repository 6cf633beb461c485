#include "fuzz/memory_guard.hpp"

#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

#if defined(__SANITIZE_ADDRESS__)
#define FASCICLE_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FASCICLE_ASAN 1
#endif
#endif

namespace fascicle::fuzz {
namespace {

std::atomic<std::ptrdiff_t> live = 0, peak = 0;

/// Not in one step, which shows in the time of targets that allocate much: readers have one thread, and with more the sums
/// would only be less exact.
void add(std::ptrdiff_t bytes) {
    const std::ptrdiff_t now = live.load(std::memory_order_relaxed) + bytes;
    live.store(now, std::memory_order_relaxed);
    if (now > peak.load(std::memory_order_relaxed))
        peak.store(now, std::memory_order_relaxed);
}

} // namespace

std::size_t live_memory() {
    return static_cast<std::size_t>(live.load());
}
std::size_t peak_memory() {
    return static_cast<std::size_t>(peak.load());
}
void reset_peak_memory() {
    peak.store(live.load());
}

} // namespace fascicle::fuzz

#ifdef FASCICLE_ASAN

#include <sanitizer/allocator_interface.h>

namespace {

void on_malloc(const volatile void*, std::size_t size) {
    fascicle::fuzz::add(static_cast<std::ptrdiff_t>(size));
}
void on_free(const volatile void* pointer) {
    if (pointer != nullptr)
        fascicle::fuzz::add(
            -static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(const_cast<const void*>(pointer))));
}
const int hooked = __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free);

} // namespace

#elif !defined(__SANITIZE_THREAD__)

namespace {

void* allocate(std::size_t size, std::size_t alignment) {
    void* pointer = alignment > alignof(std::max_align_t)
                        ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                        : std::malloc(size == 0 ? 1 : size);
    if (pointer == nullptr)
        throw std::bad_alloc();
    fascicle::fuzz::add(static_cast<std::ptrdiff_t>(::malloc_usable_size(pointer)));
    return pointer;
}
void release(void* pointer) {
    if (pointer != nullptr)
        fascicle::fuzz::add(-static_cast<std::ptrdiff_t>(::malloc_usable_size(pointer)));
    std::free(pointer);
}

} // namespace

// The other forms of the standard library call these.
void* operator new(std::size_t size) {
    return allocate(size, 0);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* pointer) noexcept {
    release(pointer);
}
void operator delete(void* pointer, std::size_t) noexcept {
    release(pointer);
}
void operator delete(void* pointer, std::align_val_t) noexcept {
    release(pointer);
}
void operator delete(void* pointer, std::size_t, std::align_val_t) noexcept {
    release(pointer);
}

#endif
