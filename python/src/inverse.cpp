#include <cstdint>
#include <limits>
#include <utility>

#include <beeline/collision/collision_model.h>

#include "bindings.h"
#include "collision_fields.h"
#include "interruption.h"
#include "inverse_fields.h"
#include "plane_poses.h"
#include "rows.h"

namespace beeline::python {
namespace {

/// The options. Throws Error for a model of another arm.
InverseOptions inverse_options(const Arm& arm, const nb::dict& keywords) {
  if (keywords.empty()) return {};
  check_options_of(arm, keywords);
  return options<InverseOptions>(nb::borrow<nb::kwargs>(keywords));
}

/// Writes solutions into the rows of an array, and NaN into the others. Returns their number.
int solve_into(const Arm& arm, const Pose& world_T_tool, nb::handle out, InverseOptions& with) {
  const InputArray shaped(out, "out");
  const auto shape = shaped.shape();
  const bool fits =
      !shape.empty() && shape.size() <= 2 && shape.back() == arm.dof() && shaped.size() > 0;
  if (!fits) {
    const std::string n = std::to_string(arm.dof());
    throw Error("out has the shape " + shape_text(shape) + "; expected (" + n + ",) or (N, " + n +
                ")");
  }
  OutputArray results(out, "out", shape, Real::float64);
  Eigen::Map<Eigen::MatrixXd> columns(results.data(), arm.dof(), shaped.rows(1));
  const Configuration seed = with.seed ? *with.seed : middle_configuration(arm);
  if (!with.seed && !with.redundancy) with.redundancy = Redundancy::any;
  const int count = unlocked(
      with.budget, [&] { return inverse_kinematics(arm, world_T_tool, seed, columns, with); });
  columns.rightCols(columns.cols() - count).setConstant(std::numeric_limits<double>::quiet_NaN());
  results.finish();
  return count;
}

/// The result, computed in the memory of its object: a result is large, and a move takes long.
nb::object solved_object(const Arm& arm, const Pose& world_T_tool, InverseOptions& with) {
  nb::object result = nb::inst_alloc(nb::type<InverseResult>());
  new (nb::inst_ptr<InverseResult>(result)) InverseResult(
      unlocked(with.budget, [&] { return inverse_kinematics(arm, world_T_tool, with); }));
  nb::inst_mark_ready(result);
  return result;
}

/// Poses of a batch as columns of the layout.
struct PoseColumns {
  Eigen::MatrixXd values;
  std::vector<Index> shape;  ///< of the batch
};

PoseColumns columns_of(const std::vector<Pose>& poses) {
  PoseColumns columns{Eigen::MatrixXd(16, poses.size()), {static_cast<Index>(poses.size())}};
  for (Index i = 0; i < columns.values.cols(); ++i) {
    Eigen::Map<Eigen::Matrix4d>(columns.values.col(i).data()) =
        poses[static_cast<std::size_t>(i)].matrix();
  }
  return columns;
}

PoseColumns pose_columns(const PosePlane& plane, nb::handle value, PoseLayout layout) {
  constexpr const char* name = "world_T_tool";
  const bool matrix = layout == PoseLayout::matrix;
  if (matrix && !is_array(value)) return columns_of(plane.poses(value, name));
  const InputArray array(value, name);
  const auto shape = array.shape();
  if (matrix && plane.planar_shape(shape)) {
    check_rows(array);
    PoseColumns columns{Eigen::MatrixXd(16, array.rows(1)), {shape.begin(), shape.end() - 1}};
    for (Index i = 0; i < columns.values.cols(); ++i) {
      columns.values.col(i) = plane.pose_of(array.data() + 3 * i).matrix().reshaped();
    }
    return columns;
  }
  const std::size_t inner = matrix ? 2 : 1;
  if (shape.size() < inner || shape.back() != (matrix ? 4 : 7) ||
      (matrix && shape[shape.size() - 2] != 4)) {
    throw Error(std::string(name) + " has the shape " + shape_text(shape) + "; expected " +
                (matrix ? "(N, 4, 4)" : "(N, 7)"));
  }
  const Index count = array.rows(static_cast<int>(inner));
  PoseColumns columns{Eigen::MatrixXd(size(layout), count), {shape.begin(), shape.end() - inner}};
  for (Index i = 0; i < count; ++i) {
    if (matrix) {
      const Eigen::Map<const Eigen::Matrix4d> rows(array.data() + 16 * i);  // transposed
      Eigen::Map<Eigen::Matrix4d>(columns.values.col(i).data()) = rows.transpose();
    } else {
      columns.values.col(i) = Eigen::Map<const Eigen::VectorXd>(array.data() + 7 * i, 7);
    }
  }
  return columns;
}

/// The keyword's value, which is taken out of `keywords`, or None.
nb::object taken(nb::dict& keywords, const char* keyword) {
  if (!keywords.contains(keyword)) return nb::none();
  nb::object value = keywords[keyword];
  nb::del(keywords[keyword]);
  return value;
}

Eigen::MatrixXd seeds_from(const Arm& arm, nb::handle value, const PoseColumns& poses) {
  if (value.is_none()) return middle_configuration(arm);
  const Configurations seeds(arm, value, "seed");
  if (!seeds.one() && seeds.shape({}) != poses.shape) {
    throw Error("seed has the shape " + shape_text(seeds.shape({arm.dof()})) + "; expected (" +
                std::to_string(arm.dof()) + ",), or one for each pose");
  }
  return Eigen::Map<const Eigen::MatrixXd>(seeds.data(), arm.dof(), seeds.count());
}

/// `seed` and `out` are options too: named parameters take less time in control loops.
BatchInverseResult batch(const Arm& arm, nb::handle world_T_tool, nb::handle seed, nb::handle out,
                         const nb::kwargs& given) {
  nb::dict keywords = nb::borrow<nb::dict>(given);
  BatchOptions with;
  if (const nb::object threads = taken(keywords, "threads"); !threads.is_none()) {
    with.threads = threads_from(threads);
  }
  if (const nb::object layout = taken(keywords, "layout"); !layout.is_none()) {
    with.layout = Value<PoseLayout>::from(layout, "layout");
  }
  const nb::object progress = taken(keywords, "progress");
  InverseOptions inverse = inverse_options(arm, keywords);
  with.budget = std::exchange(inverse.budget, Budget());
  with.budget.progress = progress_of(progress);
  const PoseColumns poses = pose_columns(PosePlane(arm), world_T_tool, with.layout);
  const Eigen::MatrixXd seeds = seeds_from(arm, seed, poses);
  if (seed.is_none() && !inverse.redundancy) inverse.redundancy = Redundancy::any;
  std::vector<Index> shape = poses.shape;
  shape.push_back(arm.dof());
  OutputArray results(out, "out", shape, Real::float64);
  Eigen::Map<Eigen::MatrixXd> q(results.data(), arm.dof(), poses.values.cols());
  const BatchResult result = unlocked(
      with.budget, [&] { return batch_inverse(arm, poses.values, seeds, q, inverse, with); });
  return {{results.finish()}, result.ending, result.computed, result.solved};
}

/// Whether a keyword has a result of many poses, also for one.
bool has_batch_keyword(const nb::kwargs& keywords) {
  if (keywords.empty()) return false;
  return keywords.contains("layout") || keywords.contains("threads");
}

/// One pose or many.
nb::object inverse(const Arm& arm, nb::handle pose, nb::handle seed, nb::handle out,
                   const nb::kwargs& keywords) {
  const PosePlane plane(arm);
  if (has_batch_keyword(keywords) || plane.many(pose)) {
    return nb::cast(batch(arm, pose, seed, out, keywords));
  }
  InverseOptions with = inverse_options(arm, keywords);
  with.seed = Value<std::optional<Configuration>>::from(seed, "seed");
  const Pose world_T_tool = plane.pose(pose, "world_T_tool");
  if (!out.is_none()) return nb::cast(solve_into(arm, world_T_tool, out, with));
  return solved_object(arm, world_T_tool, with);
}

Signature& takes_pose(Signature& signature) {
  return signature.takes("world_T_tool", arm_pose_like,
                         "Pose of the tool (4, 4); of a planar arm also [x, y, theta] or a Pose2; "
                         "or an SE3 of pinocchio or spatialmath, or a RigidTransform of scipy.");
}

/// The signature of a function that takes many poses.
Signature many_signature(const char* name, const char* summary) {
  Signature signature(name, "BatchInverseResult", summary);
  signature.takes_arm()
      .takes("world_T_tool", arm_poses_like,
             "Poses (..., 4, 4), or a list of poses; of a planar arm also (..., 3), x, y, theta "
             "each, or Pose2. A pose that is not finite has no solution.")
      .keywords()
      .takes("layout", Value<PoseLayout>::type(),
             "`position_quaternion`: poses are (..., 7), x y z qw qx qy qz.", "'matrix'")
      .member<&BatchOptions::threads>()
      .takes("out", std::string(array_type) + " | None", "Array for q.", "None")
      .progress()
      .options<InverseOptions>();
  return signature;
}

void bind_inverse_kinematics(nb::module_& m) {
  // The same function for each annotation.
  const auto add = [&](const Signature& signature) {
    define_on_arm(m, &inverse, signature, nb::arg("arm"), nb::arg("world_T_tool"), nb::kw_only(),
                  nb::arg("seed") = nb::none(), nb::arg("out") = nb::none(), nb::arg("options"));
  };
  Signature one("inverse_kinematics", "InverseResult", comment("inverse_kinematics"));
  takes_pose(one.takes_arm()).options<InverseOptions>();
  add(one.returns("True when solved."));

  Signature into(
      "inverse_kinematics", "int",
      "For control loops: writes the solutions, nearest to the seed first, into the rows of `out`, "
      "as many as fit, without a diagnosis of failures. The other rows become NaN.");
  takes_pose(into.takes_arm())
      .keywords()
      .takes("out", array_type, "(n,), or (N, n) with the option `all`.")
      .options<InverseOptions>()
      .returns("The number of solutions written.");
  add(into);

  add(many_signature(
      "inverse_kinematics",
      "For many poses: computes one solution for each, as batch_inverse() does; `all` "
      "raises Error, and `seed` is also (..., n), one for each pose. "
      "Which result it is follows from the shape of the poses; with `layout` or "
      "`threads` one pose too has this one."));

  define(m, &batch,
         many_signature(
             "batch_inverse",
             "Computes one solution for each of many poses, by all cores. It takes the keywords "
             "of inverse_kinematics(); `seed` is also (..., n), one for each pose, and without it "
             "the default of `redundancy` is `any`; `all` raises Error; the budget "
             "is for the whole batch."),
         nb::arg("arm"), nb::arg("world_T_tool"), nb::kw_only(), nb::arg("seed") = nb::none(),
         nb::arg("out") = nb::none(), nb::arg("options"));
}

void bind_inverse_method(nb::module_& m) {
  Signature method("inverse_method", "str", comment("inverse_method"));
  method.takes_arm().options<InverseOptions>();
  define_on_arm(
      m,
      [](const Arm& arm, const nb::kwargs& keywords) {
        return inverse_method(arm, inverse_options(arm, keywords));
      },
      method, nb::arg("arm"), nb::arg("options"));
}

}  // namespace

Value<std::function<Reason(const ConfigurationRef&)>>::Function
Value<std::function<Reason(const ConfigurationRef&)>>::from(nb::handle value, const char* name) {
  if (value.is_none()) return {};
  return [model = shared_model(value, name)](const ConfigurationRef& q) {
    return blocked_by(*model, q);
  };
}

void bind_inverse(nb::module_& m) {
  bind_record<NearestMiss>(m);
  bind_record<SolutionGrid>(m);
  bind_record<BlockedSolution>(m);
  // Objects that a loop has dropped are used again, without an allocation.
  constexpr std::uint32_t kept = 16;
  nb::class_<InverseResult> result = bind_record<InverseResult>(m, nb::pooled(kept));
  result.def_prop_ro(
      "q",
      [](const InverseResult& self) {
        return self.solutions.empty() ? nb::none()
                                      : Value<Configuration>::to(self.solutions.front());
      },
      getter("q", std::string(array_type) + " | None"), "The first solution (n,), or None.");
  nb::class_<BatchInverseResult> many = bind_record<BatchInverseResult>(m);
  many.def_prop_ro(
      "has_solution",
      [](const BatchInverseResult& self) {
        const nb::object first = self.q.array[nb::make_tuple(nb::ellipsis(), 0)];
        return nb::object(nb::module_::import_("numpy").attr("isfinite")(first));
      },
      getter("has_solution", "numpy.typing.NDArray[numpy.bool_]"),
      "Which poses have a solution (...).");

  bind_inverse_kinematics(m);
  bind_inverse_method(m);
}

}  // namespace beeline::python
