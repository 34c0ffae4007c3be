#include "bindings.h"
#include "kinematics_fields.h"
#include "rows.h"

namespace beeline::python {
namespace {

constexpr const char* task_doc =
    "spatial, position, planar; direction, direction:x, direction:y, approach:xy, approach:xz or "
    "approach:yz, five components; a mask such as 111010, or of a planar arm's x, y, theta such as "
    "110; with :tool in the tool's axes.";
const std::string optional_task_doc = std::string("Default: default_task(). ") + task_doc;

constexpr const char* matrix_doc = "Rows of a Jacobian, at most six, (m, n).";

nb::object scaled_jacobian(const Arm& arm, nb::handle q, nb::handle task_name, nb::handle unit,
                           nb::handle out) {
  const Configurations configurations(arm, q);
  const Task task = task_of(arm, task_name);
  const double length_unit = Value<double>::from(unit, "length_unit");
  return for_rows(configurations, {task.size(), arm.dof()}, out, [&](Index i, double* result) {
    Eigen::Map<Eigen::MatrixXd> columns(result, task.size(), arm.dof());
    columns = task_jacobian(arm, configurations.row(i), task, length_unit);
  });
}

std::vector<std::string> row_names_of(nb::handle rows) {
  const std::string name = Value<std::string>::from(rows, "rows");
  const auto known = orientation_coordinates_names();
  if (std::ranges::find(known, name) != known.end()) {
    return row_names(orientation_coordinates_named(name));
  }
  return row_names(task_named(name));
}

void bind_measures(nb::module_& m) {
  Signature measures("manipulability_measures", "ManipulabilityMeasures",
                     comment("manipulability_measures"));
  measures.takes("jacobian", array_like, matrix_doc);
  define(
      m,
      [](nb::handle matrix) {
        return manipulability_measures(Value<Eigen::MatrixXd>::from(matrix, "jacobian"));
      },
      measures, nb::arg("jacobian"));
  Signature ellipsoids("manipulability_ellipsoids", "ManipulabilityEllipsoids",
                       comment("manipulability_ellipsoids"));
  ellipsoids.takes("jacobian", array_like, matrix_doc);
  define(
      m,
      [](nb::handle matrix) {
        return manipulability_ellipsoids(Value<Eigen::MatrixXd>::from(matrix, "jacobian"));
      },
      ellipsoids, nb::arg("jacobian"));
  Signature gradient("manipulability_gradient", "ManipulabilityGradient",
                     "Returns the manipulability of the task's rows and its gradient, by Jacobi's "
                     "formula for the derivative of det(J J^T).");
  gradient.takes_arm()
      .takes("q", array_like, "Configuration (n,).")
      .takes("task", "str | None", optional_task_doc, "None");
  define(
      m,
      [](const Arm& arm, nb::handle q, nb::handle task) {
        return manipulability_gradient(arm, Value<Configuration>::from(q, "q"), task_of(arm, task));
      },
      gradient, nb::arg("arm"), nb::arg("q"), nb::arg("task") = nb::none());
}

void bind_rates(nb::module_& m) {
  bind_record<RateExcess>(m);
  bind_record<JointRates>(m);
  Signature rates("joint_rates", "JointRates", comment("joint_rates"));
  rates.takes_arm()
      .takes("q", array_like, "Configuration (n,).")
      .takes("velocity", array_like,
             "One number for each row of the task, in the frame: m/s and rad/s, (m,).")
      .options<JointRatesOptions>();
  rates.returns("True when the rates give the velocity, or are damped.");
  define_on_arm(
      m,
      [](const Arm& arm, nb::handle q, nb::handle velocity, const nb::kwargs& keywords) {
        return joint_rates(arm, Value<Configuration>::from(q, "q"),
                           Value<Eigen::VectorXd>::from(velocity, "velocity"),
                           options<JointRatesOptions>(keywords));
      },
      rates, nb::arg("arm"), nb::arg("q"), nb::arg("velocity"), nb::arg("options"));
}

void bind_errors(nb::module_& m) {
  Signature error("pose_error", array_type,
                  "Returns pose_difference(desired, current) in the axes of the frame, (6,).");
  error.takes("desired", array_like, pose_doc)
      .takes("current", array_like, pose_doc)
      .takes("frame", Value<Frame>::type(),
             "`base`, the world's; or `tool`, the axes of `current`.", "'base'");
  define(
      m,
      [](nb::handle desired, nb::handle current, nb::handle frame) {
        return Value<Twist>::to(pose_error(Value<Pose>::from(desired, "desired"),
                                           Value<Pose>::from(current, "current"),
                                           Value<Frame>::from(frame, "frame")));
      },
      error, nb::arg("desired"), nb::arg("current"), nb::arg("frame") = "base");

  const auto of_task = [&](const char* name, const std::string& returns, const char* summary,
                           auto evaluate) {
    Signature signature(name, returns, summary);
    signature.takes("task", "str", task_doc)
        .takes("desired", array_like, pose_doc)
        .takes("current", array_like, pose_doc);
    define(
        m,
        [evaluate](nb::handle task, nb::handle desired, nb::handle current) {
          return evaluate(Value<Task>::from(task, "task"), Value<Pose>::from(desired, "desired"),
                          Value<Pose>::from(current, "current"));
        },
        signature, nb::arg("task"), nb::arg("desired"), nb::arg("current"));
  };
  of_task("task_error", array_type,
          "Returns the task's rows of pose_error(), the error E of the chapter's section 1.8.",
          [](const Task& task, const Pose& desired, const Pose& current) {
            return Value<Eigen::VectorXd>::to(task_error(task, desired, current));
          });
  of_task("task_deviation", "Deviation", "Returns the norms of task_error()'s two parts.",
          &task_deviation);

  Signature rows("task_rows", array_type, "Returns the task's rows of a twist.");
  rows.takes("task", "str", task_doc).takes("twist", array_like, "[vx vy vz wx wy wz], (6,).");
  define(
      m,
      [](nb::handle task, nb::handle twist) {
        return Value<Eigen::VectorXd>::to(
            task_rows(Value<Task>::from(task, "task"), Value<Twist>::from(twist, "twist")));
      },
      rows, nb::arg("task"), nb::arg("twist"));
  Signature inside("within", "bool", comment("within"));
  inside.takes("deviation", "Deviation").takes("tolerance", "Deviation");
  define(m, &within, inside, nb::arg("deviation"), nb::arg("tolerance"));
}

}  // namespace

void bind_tasks(nb::module_& m) {
  bind_record<Deviation>(m);
  bind_record<ManipulabilityMeasures>(m);
  bind_record<ManipulabilityEllipsoids>(m);
  bind_record<ManipulabilityGradient>(m);
  Signature usual("default_task", "str", "Returns `planar` for a planar arm, else `spatial`.");
  usual.takes("arm", arm_like);
  define(
      m, [](const Arm& arm) { return Value<Task>::to(default_task(arm)); }, usual, nb::arg("arm"));
  Signature names("row_names", "list[str]",
                  "Returns the names of the rows of a task's Jacobian, or of the analytical one.");
  names.takes("rows", "str",
              "The task; or the coordinates of analytical_jacobian(), such as `quaternion`.");
  define(
      m, [](nb::handle rows) { return Value<std::vector<std::string>>::to(row_names_of(rows)); },
      names, nb::arg("rows"));
  Signature task("task_jacobian", array_type,
                 "Returns the task's rows of the Jacobian in the task's frame, its linear rows "
                 "divided by `length_unit`: so scaled, metres and radians compare.");
  task.takes_arm()
      .takes("q", array_like, configurations_doc)
      .takes("task", "str | None", optional_task_doc, "None")
      .takes("length_unit", "float", "Metres.", "1.0")
      .keywords()
      .takes("out", std::string(array_type) + " | None",
             "Array for the result, apart from the arguments.", "None")
      .returns("(m, n), or (..., m, n).");
  define(m, &scaled_jacobian, task, nb::arg("arm"), nb::arg("q"), nb::arg("task") = nb::none(),
         nb::arg("length_unit") = 1.0, nb::kw_only(), nb::arg("out") = nb::none());
  bind_measures(m);
  bind_rates(m);
  bind_errors(m);
}

}  // namespace beeline::python
