#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdlib>

/// \file
/// Counts this thread's allocations in `allocations`, for one file of a test program. Eigen calls
/// malloc itself, so that counting operator new would miss its own.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define BEELINE_COUNTS_ALLOCATIONS 0  // sanitizers replace malloc
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define BEELINE_COUNTS_ALLOCATIONS 0
#endif
#endif
#if !defined(BEELINE_COUNTS_ALLOCATIONS) && defined(__GLIBC__)
#define BEELINE_COUNTS_ALLOCATIONS 1
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
