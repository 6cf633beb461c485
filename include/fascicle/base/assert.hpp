#pragma once
// FASCICLE_ASSERT: a mistake of the caller, not of the user. Cheap, so it stays in release builds; aborts
// with place.

namespace fascicle::detail {
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);
}

#define FASCICLE_ASSERT(condition)                                                                           \
    ((condition) ? static_cast<void>(0)                                                                      \
                 : ::fascicle::detail::assertion_failed(#condition, __FILE__, __LINE__))
