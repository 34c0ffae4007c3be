// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_SIMD_FALLBACK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_SIMD_FALLBACK_INL_H
#undef BEELINE_SIMD_FALLBACK_INL_H
#else
#define BEELINE_SIMD_FALLBACK_INL_H
#endif

#include <hwy/highway.h>

// With GCC, the target for machines without SSE4 is HWY_SCALAR, whose registers have one lane. It
// is compiled with -O1, because at -O3 it takes most of the time to compile the kernels.
#if HWY_TARGET == HWY_SCALAR && HWY_COMPILER_GCC_ACTUAL && defined(__OPTIMIZE__)
#undef HWY_BEFORE_NAMESPACE
#define HWY_BEFORE_NAMESPACE() \
  _Pragma("GCC push_options")  \
      _Pragma("GCC optimize (\"O1\")") static_assert(true, "For requiring trailing semicolon")
#undef HWY_AFTER_NAMESPACE
#define HWY_AFTER_NAMESPACE() \
  _Pragma("GCC pop_options") static_assert(true, "For requiring trailing semicolon")
#endif

#endif
