#include <algorithm>
#include <thread>

#include <beeline/io/internal/csv_writer.h>
#include <beeline/io/text/internal/csv_items.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

/// Formats the rows of `block` from `first` to before `last` into `text`, which must be long
/// enough.
void format(const Eigen::Ref<const Eigen::MatrixXd>& block, Eigen::Index first, Eigen::Index last,
            std::string& text) {
  char* at = text.data();
  for (Eigen::Index row = first; row < last; ++row) {
    for (Eigen::Index k = 0; k < block.rows(); ++k) {
      at = write_double(at, block(k, row));
      *at++ = k + 1 < block.rows() ? ',' : '\n';
    }
  }
  text.resize(static_cast<std::size_t>(at - text.data()));
}

/// Runs part(0) to part(count - 1), each in a thread of its own, the first in this one.
template <typename Part>
void run_parts(Eigen::Index count, const Part& part) {
  struct Joined {  // std::jthread, which libc++ 14 lacks
    std::vector<std::thread> threads;
    ~Joined() {
      for (std::thread& thread : threads) thread.join();
    }
  } others;
  for (Eigen::Index i = 1; i < count; ++i) others.threads.emplace_back(part, i);
  part(0);
}

}  // namespace

CsvWriter::CsvWriter(const std::string& path, const std::vector<std::string>& names, int threads)
    : file_(path, Dash::standard) {
  const unsigned all = std::max(1U, std::thread::hardware_concurrency());
  texts_.resize(threads > 0 ? static_cast<std::size_t>(threads) : all);
  std::string header;
  for (const std::string& name : names) header += (header.empty() ? "" : ",") + csv_name(name);
  file_.append(header + "\n");
}

void CsvWriter::write(const Eigen::Ref<const Eigen::MatrixXd>& block) {
  constexpr Eigen::Index rows_per_thread =
      1024;  // formatting these takes longer than a thread's start
  const auto parts = std::min<Eigen::Index>(static_cast<Eigen::Index>(texts_.size()),
                                            1 + block.cols() / rows_per_thread);
  const auto start = [&](Eigen::Index i) { return block.cols() * i / parts; };
  // Allocates here: an exception must not leave a thread.
  for (Eigen::Index i = 0; i < parts; ++i) {
    const auto numbers = static_cast<std::size_t>((start(i + 1) - start(i)) * block.rows());
    texts_[static_cast<std::size_t>(i)].resize(numbers * (max_number_length + 1));
  }
  run_parts(parts, [&](Eigen::Index i) {
    format(block, start(i), start(i + 1), texts_[static_cast<std::size_t>(i)]);
  });
  for (Eigen::Index i = 0; i < parts; ++i) file_.append(texts_[static_cast<std::size_t>(i)]);
}

}  // namespace beeline::internal
