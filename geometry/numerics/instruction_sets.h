// Functions that exist twice in the program: for processors with an extension, and for all. The loader chooses; both
// give the same bits.
#pragma once

// GCC's loader functions run before the thread sanitizer is ready for them.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_THREAD__)
// With the processor's fused multiply-add in place of the library's function. (Not for virtual functions: g++ 12
// fails.)
#define LEKALO_FUSED __attribute__((target_clones("fma", "default")))
// With four doubles in one register in place of two; what it calls is compiled into it.
#define LEKALO_WIDE __attribute__((target_clones("avx2", "default"), flatten))
#else
#define LEKALO_FUSED
#define LEKALO_WIDE
#endif
