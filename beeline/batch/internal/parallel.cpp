#include <algorithm>

#include <beeline/batch/internal/parallel.h>

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#ifdef BEELINE_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace beeline::internal {
namespace {

/// Declares to the thread sanitizer what oneTBB guarantees: the loop begins before each of its
/// blocks, and ends after them. No order is declared between two blocks, so that races between them
/// are reported. The sanitizer does not see oneTBB's own synchronisation, because the library is
/// compiled without the sanitizer. This file instantiates oneTBB's templates and is therefore
/// compiled without it too (CMakeLists.txt).
class LoopOrder {
#ifdef BEELINE_THREAD_SANITIZER
 public:
  LoopOrder() { __tsan_release(&begin_); }
  ~LoopOrder() { __tsan_acquire(&end_); }
  void begin_block() { __tsan_acquire(&begin_); }
  void end_block() { __tsan_release(&end_); }

 private:
  char begin_ = 0, end_ = 0;
#else
 public:
  void begin_block() {}
  void end_block() {}
#endif
};

}  // namespace

void in_parallel(Eigen::Index count, Eigen::Index block, int threads,
                 const std::function<void(Eigen::Index, Eigen::Index)>& work) {
  const auto one = [&](Eigen::Index i) { work(i * block, std::min(count, (i + 1) * block)); };
  const Eigen::Index blocks = (count + block - 1) / block;
  if (threads == 1 || blocks <= 1) {
    for (Eigen::Index i = 0; i < blocks; ++i) one(i);
    return;
  }
  LoopOrder order;
  const auto ordered = [&](Eigen::Index i) {
    order.begin_block();
    one(i);
    order.end_block();
  };
  const auto all = [&] { tbb::parallel_for(Eigen::Index(0), blocks, ordered); };
  if (threads == 0) {
    all();
  } else {
    tbb::task_arena(std::min(threads, tbb::info::default_concurrency())).execute(all);
  }
}

}  // namespace beeline::internal
