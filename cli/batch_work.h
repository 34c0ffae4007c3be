#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <beeline/batch/batch.h>
#include <beeline/io/number_rows.h>

#include "inverse_argument.h"
#include "scene_argument.h"

namespace beeline::command {

/// The arguments of all kinds of `beeline batch`.
struct BatchArguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string in, out;
  std::string layout = {};    ///< of fk; empty: --pose-form, by default the matrix
  JacobianArgument jacobian;  ///< of jacobian
  InverseArgument inverse;    ///< of ik
  SceneArgument scene;        ///< of ik
  BudgetArgument budget;
  int threads = 0;
  bool status = false;  ///< of ik: the columns `status` and `residual`
  bool single = false, skip_bad = false, json = false;

  std::string source() const { return in == "-" ? "stdin" : in; }
};

/// What was counted besides the rows.
struct BatchCounts {
  std::int64_t outside_limits = 0;  ///< configurations
  std::int64_t first_outside = 0;   ///< the row of the first
  std::int64_t solved = 0;          ///< poses
  /// Poses by InverseStatus, with --status.
  std::vector<std::int64_t> statuses = std::vector<std::int64_t>(inverse_status_names().size(), 0);
  double large_angle = 0;  ///< the first beyond a revolution
  std::int64_t large_angle_row = 0;
  std::optional<PoseForm> large_angle_form = {};
  double far_distance = 0;  ///< of the first pose that is probably in millimetres, m; 0: none is
  std::int64_t far_row = 0;
  Ending ending = Ending::complete;  ///< of the last block

  /// Notes the first row with an angle of more than 2 pi.
  template <class Angles>
  void note_angle(const Angles& angles, std::int64_t row,
                  std::optional<PoseForm> form = std::nullopt) {
    if (large_angle_row > 0 || angles.size() == 0) return;
    const double angle = angles.array().abs().maxCoeff();
    if (angle <= plausible_angle) return;
    large_angle = angle;
    large_angle_row = row;
    large_angle_form = form;
  }
};

/// A computation on rows: the columns of its input, the columns of its output, and the step that
/// turns a block of one into a block of the other, one column of `results` for each row. The step
/// reports bad rows to `bad` and removes them from the block.
struct BatchWork {
  RowForms forms;
  RowUnits units;  ///< in which the step takes the numbers
  std::vector<std::string> columns;
  /// Only so many of the forms, from the first, may be forms of rows without a header.
  std::size_t forms_without_header = std::numeric_limits<std::size_t>::max();
  Eigen::Index max_rows = 65536;  ///< in one step
  std::function<void(std::size_t form, RowBlock& block, Eigen::MatrixXd& results,
                     BatchCounts& counts, BadRows& bad)>
      step;
  std::shared_ptr<const CheckedScene> scene = nullptr;  ///< that `step` uses, if any
};

/// `arguments` and `arm` must outlive the result.
BatchWork forward_work(const BatchArguments& arguments, const Arm& arm);
BatchWork jacobian_work(const BatchArguments& arguments, const Arm& arm);
BatchWork inverse_work(const BatchArguments& arguments, const Arm& arm);

}  // namespace beeline::command
