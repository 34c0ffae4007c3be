#include "batch_work.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se2.h>

#include "blocked_solutions.h"

namespace beeline::command {
namespace {

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

/// The units in which configurations are taken, for each list of the joints' names.
RowUnits joint_units(const BatchArguments& arguments, const Arm& arm) {
  std::vector<std::string> units;
  for (int k = 0; k < arm.dof(); ++k) {
    const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
    units.emplace_back(slides ? "m" : arguments.unit.degrees ? "deg" : "rad");
  }
  return RowUnits(joint_namings(arm).size(), units);
}

/// The columns of poses that `arm` can have, first the columns of rows without a header.
std::vector<PoseColumns> goal_columns(const Arm& arm, const PoseFormat& format) {
  std::vector<PoseColumns> all;
  for (const PoseColumns& columns : all_pose_columns()) {
    if (!columns.planar || arm.planar()) all.push_back(columns);
  }
  std::stable_partition(all.begin(), all.end(), [&](const PoseColumns& columns) {
    return reads_without_names(columns, format);
  });
  return all;
}

/// The poses of a block as columns of 16 numbers; rows that are not poses are reported and removed.
void read_goals(const BatchArguments& arguments, const Arm& arm, const WrittenPose& world_T_work,
                const PoseColumns& columns, RowBlock& block, Eigen::MatrixXd& goals,
                BatchCounts& counts, BadRows& bad) {
  const PoseFormat format = arguments.unit.pose_format();
  const std::size_t size = columns.names.size();
  goals.resize(16, block.count());
  keep_rows(block, goals, [&](Eigen::Index i, const RowPosition& position) {
    try {
      WrittenPose given = written_pose({block.numbers.col(i).data(), size}, columns, format);
      given.pose = checked_pose(given.pose);
      const WrittenPose pose = in_world(arm, world_T_work, given);
      if (arm.planar() || !columns.oriented) check_pose_form(arm, pose, arguments.inverse.task);
      counts.note_angle(Eigen::Array<double, 1, 1>(given.max_angle), position.row, given.form);
      if (counts.far_row == 0) {
        counts.far_distance = distance_in_millimetres(arm, pose.pose);
        if (counts.far_distance > 0) counts.far_row = position.row;
      }
      goals.col(i) = pose.pose.matrix().reshaped();
      return true;
    } catch (const Error& error) {
      bad.report(bad_row(arguments.source(), position, error.what()));
      return false;
    }
  });
}

/// What `batch fk` writes of a pose.
struct PoseOutput {
  std::vector<std::string> columns;
  bool planar = false;  ///< x,y,theta
  PoseFormat format = {};

  /// The layout in which the poses are computed.
  PoseLayout layout() const {
    const bool quaternions = !planar && format.pose_form == PoseForm::quaternion;
    return quaternions ? PoseLayout::position_quaternion : PoseLayout::matrix;
  }
  /// Converts poses in that layout, one in each column, to the columns of the output.
  void convert(const UnitArgument& unit, Eigen::MatrixXd& poses) const;

 private:
  std::vector<double> numbers(const Pose& pose, const UnitArgument& unit) const {
    if (!planar) return pose_numbers(pose, format);
    const Vector3 p = unit.shown_position(pose);
    return {p.x(), p.y(), unit.shown(to_plane(pose).theta)};
  }
};

void PoseOutput::convert(const UnitArgument& unit, Eigen::MatrixXd& poses) const {
  const double scale = unit.millimetres ? 1000 : 1;
  if (layout() == PoseLayout::position_quaternion) {
    poses.topRows<3>() *= scale;
    return;
  }
  if (!planar && format.pose_form == PoseForm::matrix) {
    poses.middleRows<3>(12) *= scale;
    for (auto pose : poses.colwise()) Eigen::Map<Eigen::Matrix4d>(pose.data()).transposeInPlace();
    return;
  }
  Eigen::MatrixXd converted(static_cast<Eigen::Index>(columns.size()), poses.cols());
  Pose pose;
  for (Eigen::Index i = 0; i < poses.cols(); ++i) {
    pose.matrix() = Eigen::Map<const Eigen::Matrix4d>(poses.col(i).data());
    const std::vector<double> values = numbers(pose, unit);
    converted.col(i) = Eigen::Map<const Eigen::VectorXd>(values.data(), converted.rows());
  }
  poses = std::move(converted);
}

PoseOutput pose_output(const BatchArguments& arguments, const Arm& arm) {
  if (arguments.layout == "planar") {
    if (!arm.planar()) throw Error("--layout planar is for planar arms; " + arm.name() + " is not");
    return {.columns = all_pose_columns().front().names, .planar = true};
  }
  const PoseForm form = arguments.layout == "pose" ? PoseForm::quaternion : PoseForm::matrix;
  const PoseFormat format = arguments.unit.pose_format(Triple::planar, form);
  return {.columns = pose_columns(*format.pose_form), .format = format};
}

}  // namespace

BatchWork forward_work(const BatchArguments& arguments, const Arm& arm) {
  const PoseOutput output = pose_output(arguments, arm);
  const BatchOptions options{.layout = output.layout(), .threads = arguments.threads};
  const auto step = [&arm, &arguments, options, output, rows = Configurations(arguments, arm)](
                        std::size_t, RowBlock& block, Eigen::MatrixXd& results, BatchCounts& counts,
                        BadRows& bad) {
    rows.convert(block, counts);
    results.resize(size(options.layout), block.count());
    BatchOptions limited = options;
    limited.budget = arguments.budget.next();
    counts.ending =
        batch_forward<double>(arm, block.numbers.leftCols(block.count()), results, limited).ending;
    if (counts.ending != Ending::complete) return;
    output.convert(arguments.unit, results);
    rows.check(block, results, bad);
  };
  return {.forms = joint_namings(arm),
          .units = joint_units(arguments, arm),
          .columns = output.columns,
          .forms_without_header = 1,
          .step = step};
}

BatchWork jacobian_work(const BatchArguments& arguments, const Arm& arm) {
  const Task task = arguments.jacobian.read(arm);
  BatchWork work{.forms = joint_namings(arm),
                 .units = joint_units(arguments, arm),
                 .columns = {},
                 .forms_without_header = 1,
                 .step = {}};
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

namespace {

/// Reads the scene, if one is given, and sets the option that blocks solutions.
std::shared_ptr<const CheckedScene> scene_of(const BatchArguments& arguments, const Arm& arm,
                                             InverseOptions& options) {
  std::optional<CheckedScene> read = arguments.scene.read(arguments.arm, arm);
  if (!read) return nullptr;
  auto scene = std::make_shared<const CheckedScene>(std::move(*read));
  warn_if_unchecked(*scene);
  options.blocked_by = blocked_in(*scene);
  return scene;
}

}  // namespace

BatchWork inverse_work(const BatchArguments& arguments, const Arm& arm) {
  InverseOptions options = arguments.inverse.read(arm, arguments.arm, arguments.unit);
  const auto scene = scene_of(arguments, arm, options);
  const Configuration seed = options.seed ? *options.seed : middle_configuration(arm);
  if (!options.seed && !options.redundancy) options.redundancy = Redundancy::any;
  // Checks the options before rows are read; a lock outside the limits is found by solving.
  Eigen::MatrixXd any(arm.dof(), 1);
  inverse_kinematics(arm, forward_kinematics(arm, seed), seed, any, options);
  BatchWork work{
      .forms = {}, .units = {}, .columns = arm.joint_names(), .max_rows = 4096, .step = {}};
  if (arguments.status) work.columns.insert(work.columns.end(), {"status", "residual"});
  const PoseFormat format = arguments.unit.pose_format(triple_of(arm));
  const std::vector<PoseColumns> goals_by_form = goal_columns(arm, format);
  for (const PoseColumns& columns : goals_by_form) {
    work.forms.push_back(columns.names);
    std::vector<std::string>& units = work.units.emplace_back();
    for (const std::string& column : columns.names) {
      units.push_back(unit_of_column(column, format));
    }
  }
  work.forms_without_header = static_cast<std::size_t>(
      std::count_if(goals_by_form.begin(), goals_by_form.end(),
                    [&](const auto& columns) { return reads_without_names(columns, format); }));
  const WrittenPose world_T_work = arguments.inverse.work.read(arm, arguments.unit);
  work.scene = scene;
  work.step = [&arguments, &arm, options, seed, world_T_work, goals_by_form,
               width = work.columns.size(), goals = Eigen::MatrixXd(),
               outcomes = std::vector<InverseOutcome>()](
                  std::size_t form, RowBlock& block, Eigen::MatrixXd& results, BatchCounts& counts,
                  BadRows& bad) mutable {
    read_goals(arguments, arm, world_T_work, goals_by_form[form], block, goals, counts, bad);
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
        if (result.ending == Ending::complete) {
          ++counts.statuses.at(static_cast<std::size_t>(outcome.status));
        }
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

}  // namespace beeline::command
