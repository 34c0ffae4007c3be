#include <beeline/io/text/internal/npy.h>

#include <tests/fuzz/target.h>

BEELINE_FUZZ_TARGET(npy_header) {
  using namespace beeline;
  fuzz::may_refuse([&] {
    const internal::NpyHeader header = internal::parse_npy_header(input);
    fuzz::require(header.rows >= 0 && header.width >= 0, "a shape");
  });
}
