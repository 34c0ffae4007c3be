#pragma once

#include <functional>
#include <string>
#include <vector>

#include <beeline/batch/batch.h>
#include <beeline/record/row_block.h>

#include "inverse_argument.h"

/// What `beeline batch` is told, whatever it computes.
struct BatchArguments {
  ArmArgument arm;
  UnitArgument unit;
  TaskArgument task;  ///< of jacobian
  std::string in, out;
  std::string layout = "matrix";  ///< of fk
  std::string frame = "base";     ///< of jacobian
  InverseArgument inverse;        ///< of ik
  int threads = 0;
  bool single = false, skip_bad = false, json = false;

  std::string source() const { return in == "-" ? "stdin" : in; }
};

/// What was counted besides the rows.
struct BatchCounts {
  std::int64_t outside_limits = 0;  ///< configurations
  std::int64_t first_outside = 0;   ///< the row of the first
  std::int64_t solved = 0;          ///< poses
};

/// A computation on rows: which rows it takes, what stands in the rows that it gives, and the step
/// from some to the others, one column of `results` for each row of the block. Bad rows are met by
/// the step, and taken out of the block.
struct BatchWork {
  beeline::RowForms forms;
  std::vector<std::string> columns;
  Eigen::Index max_rows = 65536;  ///< in one step
  std::function<void(std::size_t form, beeline::RowBlock& block, Eigen::MatrixXd& results,
                     BatchCounts& counts, beeline::BadRows& bad)>
      step;
};

/// Each needs `arguments` and `arm` as long as the work lasts.
BatchWork forward_work(const BatchArguments& arguments, const beeline::Arm& arm);
BatchWork jacobian_work(const BatchArguments& arguments, const beeline::Arm& arm);
BatchWork inverse_work(const BatchArguments& arguments, const beeline::Arm& arm);
