#pragma once
// Marks a function to be compiled for wider registers as well, the copy being chosen when the program starts. Only for loops whose every
// sum has its order written down: -ffp-contract=off then makes wider registers change no bit.

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&     \
    !defined(__SANITIZE_THREAD__)
#define FASCICLE_WIDE __attribute__((target_clones("avx512f", "avx2", "default"), optimize("O3")))
#else
#define FASCICLE_WIDE
#endif
