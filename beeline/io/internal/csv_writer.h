#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include <beeline/io/text/file.h>

namespace beeline::internal {

/// Writes a header, then rows of numbers that read back exactly; NaN is `nan`. "-" is the standard
/// output.
class CsvWriter {
 public:
  CsvWriter(const std::string& path, const std::vector<std::string>& names, int threads);

  /// Each column of `block` is a row of the file. Several threads format the numbers.
  void write(const Eigen::Ref<const Eigen::MatrixXd>& block);
  void commit() { file_.commit(); }

 private:
  OutputFile file_;
  std::vector<std::string> texts_;  ///< one per thread
};

}  // namespace beeline::internal
