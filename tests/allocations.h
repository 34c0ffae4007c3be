#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdlib>

/// \file
/// Counts this thread's allocations in `allocations`, for one file of a test program. Eigen calls
/// malloc itself, so that counting operator new would miss its own.

#if defined(__GLIBC__) && !defined(BEELINE_SANITIZED)  // sanitizers replace malloc
#define BEELINE_COUNTS_ALLOCATIONS 1
#else
#define BEELINE_COUNTS_ALLOCATIONS 0
#endif

namespace {
[[maybe_unused]] thread_local long allocations = 0;
}

#if BEELINE_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT

void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** place, std::size_t alignment, std::size_t size) noexcept {
  ++allocations;
  *place = __libc_memalign(alignment, size);
  return *place == nullptr ? ENOMEM : 0;
}
}
#endif
