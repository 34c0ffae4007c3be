// Replaces parallel.cpp in a module without threads (WebAssembly).
#include <algorithm>

#include <beeline/batch/internal/parallel.h>

namespace beeline::internal {

void in_parallel(Eigen::Index count, Eigen::Index block, int /*threads*/,
                 const std::function<void(Eigen::Index, Eigen::Index)>& work) {
  for (Eigen::Index first = 0; first < count; first += block) {
    work(first, std::min(count, first + block));
  }
}

}  // namespace beeline::internal
