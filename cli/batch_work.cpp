#include "batch_work.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/read/pose_list.h>

using namespace beeline;

namespace {

std::vector<std::string> matrix_columns() {
  std::vector<std::string> names;
  for (int row = 1; row <= 4; ++row) {
    for (int column = 1; column <= 4; ++column) names.push_back(fmt::format("m{}{}", row, column));
  }
  return names;
}

const std::vector<std::string>& quaternion_columns() { return pose_forms()[2]; }

/// Keeps the rows for which `good` is true; it reports the others.
template <class Good>
void keep_rows(RowBlock& block, Eigen::MatrixXd& values, Good&& good) {
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < block.count(); ++i) {
    const RowPosition position = block.positions[i];
    if (!good(i, position)) continue;
    if (kept != i) values.col(kept) = values.col(i);
    block.positions[kept++] = position;
  }
  block.positions.resize(static_cast<std::size_t>(kept));
}

/// Converts the rows of a block to configurations, and checks results.
class Configurations {
 public:
  Configurations(const BatchArguments& arguments, const Arm& arm) : arguments_(arguments) {
    for (int k = 0; k < arm.dof(); ++k) {
      revolute_.push_back(kind(arm.joint_of(k)) != JointKind::prismatic);
    }
    const auto& limits = arm.limits();
    angles_ = Eigen::ArrayXd(arm.dof());
    for (int k = 0; k < arm.dof(); ++k) angles_[k] = revolute_[k] ? 1 : 0;
    lower_.resize(arm.dof());
    upper_.resize(arm.dof());
    for (int k = 0; k < arm.dof(); ++k) {
      lower_[k] = limits[k].lower;
      upper_[k] = limits[k].upper;
    }
  }

  void convert(RowBlock& block, BatchCounts& counts) const {
    for (Eigen::Index i = 0; i < block.count(); ++i) {
      auto q = block.numbers.col(i);
      counts.note_angle(angles_ * q.head(angles_.size()).array(), block.positions[i].row);
      for (Eigen::Index k = 0; k < q.size() && arguments_.unit.degrees; ++k) {
        if (revolute_[k]) q[k] = to_radians(q[k], AngleUnit::degrees);
      }
      if ((q.array() >= lower_).all() && (q.array() <= upper_).all()) continue;
      if (counts.outside_limits++ > 0) continue;
      counts.first_outside = block.positions[i].row;
    }
  }

  /// Removes the rows whose results exceed the range of numbers.
  void check(RowBlock& block, Eigen::MatrixXd& results, BadRows& bad) const {
    const double largest =
        arguments_.single ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    const auto fits = [largest](const auto& numbers) {
      return (numbers.array().abs() <= largest).all();
    };
    if (fits(results)) return;
    keep_rows(block, results, [&](Eigen::Index i, const RowPosition& position) {
      if (fits(results.col(i))) return true;
      bad.report(bad_row(arguments_.source(), position,
                         arguments_.single && results.col(i).allFinite()
                             ? "a result is too large for 32 bits; omit --float"
                             : "the tool's position exceeds the range of numbers"));
      return false;
    });
    results.conservativeResize(Eigen::NoChange, block.count());
  }

 private:
  const BatchArguments& arguments_;
  std::vector<bool> revolute_;
  Eigen::ArrayXd lower_, upper_;
  Eigen::ArrayXd angles_;  ///< 1 for each angle, 0 for each length
};

PoseLayout layout_named(const std::string& name) {
  if (name == "matrix") return PoseLayout::matrix;
  if (name == "pose") return PoseLayout::position_quaternion;
  throw unknown_name("layout", name, {"matrix", "pose"});
}

/// The pose of a row in one of the forms. Throws Error if it is not a pose.
Pose pose_in(const Eigen::Ref<const Eigen::VectorXd>& row, const UnitArgument& unit,
             Triple triple) {
  if (row.size() != 16) {
    return pose_of({row.data(), static_cast<std::size_t>(row.size())}, unit.angle_unit(), triple);
  }
  Pose pose = Pose::Identity();
  pose.matrix() = row.reshaped(4, 4).transpose();
  constexpr double rounding = 1e-6;
  if (!((row.tail<4>() - Eigen::Vector4d::UnitW()).cwiseAbs().maxCoeff() <= rounding)) {
    throw Error("the matrix ends in the row " + number(row[12]) + ", " + number(row[13]) + ", " +
                number(row[14]) + ", " + number(row[15]) + "; it must be 0, 0, 0, 1");
  }
  pose.makeAffine();
  return pose;
}

/// The poses of a block as columns of 16 numbers; rows that are not poses are reported and removed.
void read_goals(const BatchArguments& arguments, const Arm& arm, const WrittenPose& world_T_work,
                const std::vector<std::string>& form, RowBlock& block, Eigen::MatrixXd& goals,
                BatchCounts& counts, BadRows& bad) {
  const bool in_plane = form == pose_forms()[0] || form == pose_forms()[4];
  const bool oriented = form != pose_forms()[3] && form != pose_forms()[4];
  const Triple triple = oriented ? Triple::planar : Triple::position;
  const auto first_angle = std::find_if(form.begin(), form.end(), [](const std::string& column) {
    return column == "theta" || column == "roll";
  });
  goals.resize(16, block.count());
  keep_rows(block, goals, [&](Eigen::Index i, const RowPosition& position) {
    try {
      const auto row = block.numbers.col(i).head(static_cast<Eigen::Index>(form.size()));
      const WrittenPose given{.pose = checked_pose(pose_in(row, arguments.unit, triple)),
                              .planar = in_plane,
                              .oriented = oriented};
      const WrittenPose pose = in_world(arm, world_T_work, given);
      if (arm.planar() || !oriented) check_pose_form(arm, pose, arguments.inverse.task);
      counts.note_angle(row.tail(form.end() - first_angle), position.row);
      goals.col(i) = pose.pose.matrix().reshaped();
      return true;
    } catch (const Error& error) {
      bad.report(bad_row(arguments.source(), position, error.what()));
      return false;
    }
  });
}

}  // namespace

BatchWork forward_work(const BatchArguments& arguments, const Arm& arm) {
  const PoseLayout layout = layout_named(arguments.layout);
  const bool matrix = layout == PoseLayout::matrix;
  const BatchOptions options{.layout = layout, .threads = arguments.threads};
  const auto step = [&arm, &arguments, options, matrix, rows = Configurations(arguments, arm)](
                        std::size_t, RowBlock& block, Eigen::MatrixXd& results, BatchCounts& counts,
                        BadRows& bad) {
    rows.convert(block, counts);
    results.resize(size(options.layout), block.count());
    BatchOptions limited = options;
    limited.budget = arguments.budget.next();
    counts.ending =
        batch_forward<double>(arm, block.numbers.leftCols(block.count()), results, limited).ending;
    if (counts.ending != Ending::complete) return;
    rows.check(block, results, bad);
    if (!matrix) return;
    for (auto pose : results.colwise()) {  // the matrix row by row
      Eigen::Map<Eigen::Matrix4d>(pose.data()).transposeInPlace();
    }
  };
  return {.forms = {arm.joint_names()},
          .columns = matrix ? matrix_columns() : quaternion_columns(),
          .step = step};
}

BatchWork jacobian_work(const BatchArguments& arguments, const Arm& arm) {
  const Task task = arguments.jacobian.read(arm);
  BatchWork work{.forms = {arm.joint_names()}, .columns = {}, .step = {}};
  std::vector<Eigen::Index> source;  // of each number of the output, the matrix row by row
  for (const std::string& row : row_names({task.rows, Frame::base})) {
    for (const std::string& joint : arm.joint_names()) work.columns.push_back(row + "_" + joint);
  }
  for (Eigen::Index row = 0; row < 6; ++row) {
    if (!task.rows[row]) continue;
    for (int k = 0; k < arm.dof(); ++k) source.push_back(6 * k + row);
  }
  const BatchOptions options{.frame = task.frame, .threads = arguments.threads};
  work.step = [&arm, &arguments, options, source, rows = Configurations(arguments, arm),
               whole = Eigen::MatrixXd()](std::size_t, RowBlock& block, Eigen::MatrixXd& results,
                                          BatchCounts& counts, BadRows& bad) mutable {
    rows.convert(block, counts);
    whole.resize(6 * arm.dof(), block.count());
    Eigen::MatrixXd no_poses(size(options.layout), 0);
    BatchOptions limited = options;
    limited.budget = arguments.budget.next();
    counts.ending =
        batch_jacobian<double>(arm, block.numbers.leftCols(block.count()), whole, no_poses, limited)
            .ending;
    if (counts.ending != Ending::complete) return;
    rows.check(block, whole, bad);
    results = whole(source, Eigen::seqN(0, whole.cols()));
  };
  return work;
}

BatchWork inverse_work(const BatchArguments& arguments, const Arm& arm) {
  const InverseOptions options = arguments.inverse.read(arm, arguments.arm, arguments.unit);
  const Configuration seed = options.seed ? *options.seed : middle_configuration(arm);
  // Checks the options before rows are read; a lock outside the limits is found by solving.
  Eigen::MatrixXd any(arm.dof(), 1);
  InverseSolver(arm, options).solve(forward_kinematics(arm, seed), seed, any);
  BatchWork work{.forms = {}, .columns = arm.joint_names(), .max_rows = 4096, .step = {}};
  if (arguments.status) work.columns.insert(work.columns.end(), {"status", "residual"});
  for (const auto& form : pose_forms()) {
    const bool in_plane = form == pose_forms()[0] || form == pose_forms()[4];
    if (!in_plane || arm.planar()) work.forms.push_back(form);
  }
  work.forms.push_back(matrix_columns());
  const WrittenPose world_T_work = arguments.inverse.work.read(arm, arguments.unit);
  work.step = [&arguments, &arm, options, seed, world_T_work, forms = work.forms,
               width = work.columns.size(), goals = Eigen::MatrixXd(),
               outcomes = std::vector<InverseOutcome>()](
                  std::size_t form, RowBlock& block, Eigen::MatrixXd& results, BatchCounts& counts,
                  BadRows& bad) mutable {
    read_goals(arguments, arm, world_T_work, forms[form], block, goals, counts, bad);
    const auto world_T_tool = goals.leftCols(block.count());
    const BatchOptions batch{.threads = arguments.threads, .budget = arguments.budget.next()};
    results.resize(static_cast<Eigen::Index>(width), block.count());
    const auto q = results.topRows(arm.dof());
    BatchResult result;
    if (arguments.status) {
      result = batch_inverse(arm, world_T_tool, seed, q, outcomes, options, batch);
      for (Eigen::Index i = 0; i < block.count(); ++i) {
        const InverseOutcome& outcome = outcomes[static_cast<std::size_t>(i)];
        results.col(i).tail<2>() << static_cast<double>(outcome.status), outcome.residual;
      }
    } else {
      result = batch_inverse(arm, world_T_tool, seed, q, options, batch);
    }
    counts.ending = result.ending;
    if (counts.ending != Ending::complete) return;
    counts.solved += result.solved;
    if (!arguments.unit.degrees) return;
    for (Eigen::Index i = 0; i < block.count(); ++i) {
      results.col(i).head(arm.dof()) =
          arguments.unit.shown(arm, Configuration(results.col(i).head(arm.dof())));
    }
  };
  return work;
}
