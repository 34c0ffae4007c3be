#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/rounded.h>

namespace beeline::internal {

Vector3 rounded(const Vector3& v, int digits) {
  return {rounded(v.x(), digits), rounded(v.y(), digits), rounded(v.z(), digits)};
}

}  // namespace beeline::internal
