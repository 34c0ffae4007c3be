#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

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
  check_model_of(arm, keywords);
  return options<InverseOptions>(nb::borrow<nb::kwargs>(keywords));
}

/// InverseSolver with the arm and a copy of the keywords that it was made of. Only one thread
/// solves at a time; the others wait.
class Solver {
 public:
  Solver(nb::object arm, const nb::dict& keywords)
      : arm_(std::move(arm)),
        keywords_(copied(keywords)),
        dof_(nb::cast<const Arm&>(arm_).dof()),
        plane_(nb::cast<const Arm&>(arm_)) {
    InverseOptions all = inverse_options(nb::cast<const Arm&>(arm_), keywords_);
    all.budget.cancelled = [this] { return call_->cancelled(); };
    solver_.emplace(nb::cast<const Arm&>(arm_), all);
    method_ = solver_->method();
  }

  const nb::object& arm() const { return arm_; }
  const nb::dict& keywords() const { return keywords_; }
  int dof() const { return dof_; }
  const PosePlane& plane() const { return plane_; }
  const std::string& method() const { return method_; }

  /// work(the C++ solver), without Python's lock. Throws Error in a signal handler that interrupts
  /// the solver in the same thread.
  template <class Work>
  auto run(Work work) {
    if (owner_ == std::this_thread::get_id()) {
      throw Error("the solver is solving already, in this thread");
    }
    Budget call;
    Interruption interruption(call);  // outlives the lock of the mutex: its end needs Python's lock
    auto result = [&] {
      const LockRelease release;
      const std::lock_guard lock(mutex_);
      call_ = &call;
      const Owner owner(owner_);
      return work(*solver_);
    }();
    interruption.rethrow();
    return result;
  }

 private:
  static nb::dict copied(const nb::dict& keywords) {
    nb::dict copies;
    const nb::object deepcopy = nb::module_::import_("copy").attr("deepcopy");
    for (const auto& [keyword, value] : keywords) copies[keyword] = deepcopy(value);
    return copies;
  }

  /// Marks this thread as the one that solves, during its life.
  struct Owner {
    explicit Owner(std::atomic<std::thread::id>& thread) : id(thread) {
      id = std::this_thread::get_id();
    }
    ~Owner() { id = std::thread::id(); }
    std::atomic<std::thread::id>& id;
  };

  nb::object arm_;
  nb::dict keywords_;
  int dof_;
  PosePlane plane_;
  std::mutex mutex_;
  std::atomic<std::thread::id> owner_;
  const Budget* call_ = nullptr;  ///< of the call that solves
  std::optional<InverseSolver> solver_;
  std::string method_;
};

/// Whether the value is a list of poses: of arrays, of lists of lists, or of objects that are
/// poses.
bool is_list_of_poses(nb::handle value) {
  const auto is_list = [](nb::handle object) {
    return nb::isinstance<nb::list>(object) || nb::isinstance<nb::tuple>(object);
  };
  if (!is_list(value) || nb::len(value) == 0) return false;
  const nb::object first = value[0];
  if (!is_list(first)) {
    return is_array(first) ? InputArray(first, "world_T_tool").dimensions() == 2
                           : !PyNumber_Check(first.ptr()) && !PyUnicode_Check(first.ptr());
  }
  return nb::len(first) > 0 && is_list(nb::object(first[0]));
}

void check_one_pose(nb::handle pose) {
  const std::string advice = "; batch_inverse() takes many poses";
  if (is_array(pose) && InputArray(pose, "world_T_tool").dimensions() > 2) {
    throw Error("world_T_tool has the shape " +
                shape_text(InputArray(pose, "world_T_tool").shape()) + "; expected (4, 4)" +
                advice);
  }
  if (is_list_of_poses(pose)) {
    throw Error("world_T_tool: expected a pose (4, 4), not a list of " +
                std::to_string(nb::len(pose)) + advice);
  }
}

InverseResult solve(Solver& solver, nb::handle pose, nb::handle seed) {
  const Pose world_T_tool = solver.plane().pose(pose, "world_T_tool");
  if (seed.is_none()) {
    return solver.run([&](InverseSolver& one) { return one.solve(world_T_tool); });
  }
  const InputArray start(seed, "seed");
  if (start.dimensions() != 1)
    throw Error("seed has the shape " + shape_text(start.shape()) + "; expected (" +
                std::to_string(solver.dof()) + ",)");
  const ConfigurationRef from(Eigen::Map<const Configuration>(start.data(), start.size()));
  return solver.run([&](InverseSolver& one) { return one.solve(world_T_tool, from); });
}

int solve_into(Solver& solver, nb::handle pose, nb::handle seed, nb::handle solutions) {
  const Pose world_T_tool = solver.plane().pose(pose, "world_T_tool");
  const InputArray start(seed, "seed"), shaped(solutions, "solutions");
  const auto shape = shaped.shape();
  const bool fits = start.dimensions() == 1 && !shape.empty() && shape.size() <= 2 &&
                    shape.back() == solver.dof() && shaped.size() > 0;
  if (!fits) {
    const std::string n = std::to_string(solver.dof());
    throw Error("seed and solutions have the shapes " + shape_text(start.shape()) + " and " +
                shape_text(shape) + "; expected (" + n + ",), and the same or (N, " + n + ")");
  }
  OutputArray results(solutions, "solutions", shape, Real::float64);
  Eigen::Map<Eigen::MatrixXd> columns(results.data(), solver.dof(), shaped.rows(1));
  const Configuration from = Eigen::Map<const Configuration>(start.data(), start.size());
  const int count =
      solver.run([&](InverseSolver& one) { return one.solve(world_T_tool, from, columns); });
  columns.rightCols(columns.cols() - count).setConstant(std::numeric_limits<double>::quiet_NaN());
  results.finish();
  return count;
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

PoseColumns pose_columns(const Arm& arm, nb::handle value, PoseLayout layout) {
  constexpr const char* name = "world_T_tool";
  const bool matrix = layout == PoseLayout::matrix;
  const PosePlane plane(arm);
  if (matrix && !is_array(value)) return columns_of(plane.poses(value, name));
  const InputArray array(value, name);
  const auto shape = array.shape();
  if (matrix && plane.planar_shape(shape)) {
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

BatchInverseResult batch(const Arm& arm, nb::handle world_T_tool, const nb::kwargs& given) {
  nb::dict keywords = nb::borrow<nb::dict>(given);
  BatchOptions with;
  if (const nb::object threads = taken(keywords, "threads"); !threads.is_none()) {
    with.threads = threads_from(threads);
  }
  if (const nb::object layout = taken(keywords, "layout"); !layout.is_none()) {
    with.layout = Value<PoseLayout>::from(layout, "layout");
  }
  const nb::object seed = taken(keywords, "seed"), out = taken(keywords, "out");
  const nb::object progress = taken(keywords, "progress");
  InverseOptions inverse = inverse_options(arm, keywords);
  with.budget = std::exchange(inverse.budget, Budget());
  with.budget.progress = progress_of(progress);
  const PoseColumns poses = pose_columns(arm, world_T_tool, with.layout);
  const Eigen::MatrixXd seeds = seeds_from(arm, seed, poses);
  std::vector<Index> shape = poses.shape;
  shape.push_back(arm.dof());
  OutputArray results(out, "out", shape, Real::float64);
  Eigen::Map<Eigen::MatrixXd> q(results.data(), arm.dof(), poses.values.cols());
  const BatchResult result = unlocked(
      with.budget, [&] { return batch_inverse(arm, poses.values, seeds, q, inverse, with); });
  return {{results.finish()}, result.ending, result.computed, result.solved};
}

Signature& takes_pose(Signature& signature) {
  return signature.takes("world_T_tool", arm_pose_like,
                         "Pose of the tool (4, 4); of a planar arm also [x, y, theta] or a Pose2; "
                         "or an SE3 of pinocchio or spatialmath, or a RigidTransform of scipy.");
}

void bind_solver(nb::module_& m) {
  nb::class_<Solver> solver(
      m, "InverseSolver",
      "inverse_kinematics() for many poses of one arm: what does not depend on the pose is "
      "computed once. Threads that call one solver take turns; a copy for each works in parallel.");
  Signature made("__init__", "None", "Computes what does not depend on the pose.");
  made.takes("self").takes("arm", "Arm", "The arm.").options<InverseOptions>();
  define(
      solver,
      [](Solver* self, nb::handle arm, const nb::kwargs& keywords) {
        object_of<Arm>(arm, "arm");
        new (self) Solver(nb::borrow(arm), nb::dict(keywords));
      },
      made, nb::arg("arm"), nb::arg("keywords"));

  Signature one("solve", "InverseResult",
                "Computes joint configurations that bring the tool to a pose.");
  takes_pose(one.takes("self"))
      .takes("seed", std::string(array_like) + " | None", "In place of the option's, (n,).",
             "None");
  define(solver, &solve, one, nb::arg("world_T_tool"), nb::arg("seed") = nb::none());

  Signature into(
      "solve_into", "int",
      "For control loops: writes the solutions, nearest to the seed first, into the rows of "
      "`solutions`, as many as fit, without a diagnosis of failures. The other rows become NaN.");
  takes_pose(into.takes("self"))
      .takes("seed", array_like, "Configuration (n,).")
      .takes("solutions", array_type, "(n,), or (N, n) with the option `all`.")
      .returns("The number of solutions written.");
  define(solver, &solve_into, into, nb::arg("world_T_tool"), nb::arg("seed"), nb::arg("solutions"));

  solver.def_prop_ro(
      "method", [](Solver& self) { return self.method(); }, getter("method", "str"),
      "The closed form that the arm has, or `numerical`.");
  solver.def_prop_ro(
      "arm", [](const Solver& self) { return self.arm(); }, getter("arm", "Arm"), "The arm.");
  solver.def("__repr__", [](Solver& self) {
    return "InverseSolver(" + nb::cast<const Arm&>(self.arm()).name() + ", " + self.method() + ")";
  });
  solver.def(
      "__getstate__",
      [](const Solver& self) { return nb::make_tuple(self.arm(), self.keywords().attr("copy")()); },
      nb::sig("def __getstate__(self) -> tuple[Arm, dict[str, object]]"));
  solver.def(
      "__setstate__",
      [](Solver& self, const nb::tuple& state) {
        if (nb::len(state) != 2) throw Error("the pickled state has another number of values");
        if (!nb::isinstance<Arm>(state[0]) || !nb::isinstance<nb::dict>(state[1])) {
          throw Error("the pickled state does not belong to an InverseSolver");
        }
        new (&self) Solver(state[0], nb::borrow<nb::dict>(state[1]));
      },
      nb::sig("def __setstate__(self, state: tuple[object, ...], /) -> None"));
}

}  // namespace

Value<std::function<Reason(const ConfigurationRef&)>>::Function
Value<std::function<Reason(const ConfigurationRef&)>>::from(nb::handle value, const char* name) {
  if (value.is_none()) return {};
  if (!nb::isinstance<CollisionModel>(value)) raise_type(name, type(), value);
  const auto* const model = &nb::cast<const CollisionModel&>(value);
  return [model, held = shared_object(nb::borrow(value))](const ConfigurationRef& q) {
    return blocked_by(*model, q);
  };
}

void bind_inverse(nb::module_& m) {
  bind_record<NearestMiss>(m);
  bind_record<SolutionGrid>(m);
  bind_record<BlockedSolution>(m);
  nb::class_<InverseResult> result = bind_record<InverseResult>(m);
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

  Signature one("inverse_kinematics", "InverseResult", comment("inverse_kinematics"));
  takes_pose(one.takes("arm", "Arm", "The arm.")).options<InverseOptions>();
  one.returns("True when solved.");
  define_on_arm(
      m,
      [](const Arm& arm, nb::handle pose, const nb::kwargs& keywords) {
        check_one_pose(pose);
        const Pose world_T_tool = PosePlane(arm).pose(pose, "world_T_tool");
        InverseOptions with = inverse_options(arm, keywords);
        return unlocked(with.budget, [&] { return inverse_kinematics(arm, world_T_tool, with); });
      },
      one, nb::arg("arm"), nb::arg("world_T_tool"), nb::arg("options"));

  Signature batched(
      "batch_inverse", "BatchInverseResult",
      "Computes one solution for each of many poses, by all cores. It takes the keywords "
      "of inverse_kinematics(); `seed` is also (..., n), one for each pose; "
      "`all` and `every_turn` are ignored; the budget is for the whole batch.");
  batched.takes("arm", "Arm", "The arm.")
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
  define(m, &batch, batched, nb::arg("arm"), nb::arg("world_T_tool"), nb::arg("options"));
  bind_solver(m);
}

}  // namespace beeline::python
