#include <algorithm>

#include <beeline/batch/internal/parallel.h>

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace beeline::internal {

void in_parallel(Eigen::Index count, Eigen::Index block, int threads,
                 const std::function<void(Eigen::Index, Eigen::Index)>& work) {
  const auto one = [&](Eigen::Index i) { work(i * block, std::min(count, (i + 1) * block)); };
  const Eigen::Index blocks = (count + block - 1) / block;
  if (threads == 1 || blocks <= 1) {
    for (Eigen::Index i = 0; i < blocks; ++i) one(i);
    return;
  }
  const auto all = [&] { tbb::parallel_for(Eigen::Index(0), blocks, one); };
  if (threads == 0) {
    all();
  } else {
    tbb::task_arena(std::min(threads, tbb::info::default_concurrency())).execute(all);
  }
}

}  // namespace beeline::internal
