#include "fascicle/base/large_array.hpp"

#include <new>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace fascicle {

namespace {

constexpr std::size_t large_page = std::size_t{2} << 20;

std::align_val_t alignment(std::size_t bytes) {
    return std::align_val_t{bytes >= 2 * large_page ? large_page : alignof(std::max_align_t)};
}

} // namespace

void* allocate_large(std::size_t bytes) {
    void* memory = ::operator new(bytes, alignment(bytes));
#ifdef __linux__
    if (bytes >= 2 * large_page)
        ::madvise(memory, bytes, MADV_HUGEPAGE); // a wish: nothing is lost where it is not granted
#endif
    return memory;
}

void free_large(void* memory, std::size_t bytes) noexcept {
    ::operator delete(memory, alignment(bytes));
}

} // namespace fascicle
