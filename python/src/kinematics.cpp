#include <beeline/kinematics/forward.h>
#include <beeline/pose/se3.h>

#include "bindings.h"
#include "kinematics_fields.h"
#include "rows.h"

namespace beeline::python {
namespace {

using std::size_t;

/// Calls work with a value of the arithmetic's type.
template <class Work>
void in_arithmetic(Real real, Work work) {
  real == Real::float32 ? work(0.0F) : work(0.0);
}

template <class T>
auto columns(T* data, Index rows, Index count) {
  using Matrix = Eigen::Matrix<std::remove_const_t<T>, Eigen::Dynamic, Eigen::Dynamic>;
  return Eigen::Map<std::conditional_t<std::is_const_v<T>, const Matrix, Matrix>>(data, rows,
                                                                                  count);
}

/// Runs batch(arithmetic, configurations as columns, results as columns, options) without Python's
/// lock. `rows` is the number of results of one configuration.
template <class Batch>
void run(const Arm& arm, const Configurations& q, const OutputArray& results, Index rows,
         BatchOptions options, Batch batch) {
  in_arithmetic(q.real(), [&]<class T>(T) {
    unlocked(options.budget, [&] {
      return batch(T(), columns(q.data<T>(), arm.dof(), q.count()),
                   columns(results.data<T>(), rows, q.count()), options);
    });
  });
}

/// Poses that stand in place of the arm's base or tool: none, one for all, or one for each row.
class RowPoses {
 public:
  RowPoses(nb::handle value, const char* name, Index count) {
    if (value.is_none()) return;
    poses_ = poses_from(value, name);
    if (poses_.size() == 1 || static_cast<Index>(poses_.size()) == count) return;
    throw Error(std::string(name) + ": " + std::to_string(poses_.size()) + " poses for " +
                std::to_string(count) + " configurations");
  }
  bool given() const { return !poses_.empty(); }
  /// The pose of a row, or `fallback`.
  const Pose& of(Index i, const Pose& fallback) const {
    if (poses_.empty()) return fallback;
    return poses_[poses_.size() == 1 ? 0 : static_cast<size_t>(i)];
  }

 private:
  std::vector<Pose> poses_;
};

/// Replaces the base and the tool of poses of `arm`: column-major 4 x 4 matrices.
template <class T>
void replace_ends(const Arm& arm, const RowPoses& bases, const RowPoses& tools, T* matrices,
                  Index count) {
  using Matrix = Eigen::Matrix<T, 4, 4>;
  const Pose from_base = arm.base().inverse(), from_tool = arm.tool().inverse();
  for (Index i = 0; i < count; ++i) {
    Eigen::Map<Matrix> pose(matrices + 16 * i);
    if (bases.given()) {
      const Pose change = bases.of(i, arm.base()) * from_base;
      pose = (change.matrix().template cast<T>() * pose).eval();
    }
    if (tools.given()) {
      const Pose change = from_tool * tools.of(i, arm.tool());
      pose = (pose * change.matrix().template cast<T>()).eval();
    }
  }
}

/// Writes x y z qw qx qy qz of each matrix.
template <class T>
void write_position_quaternions(const T* matrices, T* results, Index count) {
  for (Index i = 0; i < count; ++i, matrices += 16, results += 7) {
    const Eigen::Map<const Eigen::Matrix<T, 4, 4>> pose(matrices);
    const Rotation rotation = pose.template topLeftCorner<3, 3>().template cast<double>();
    const Quaternion q = quaternion(rotation);
    const double values[] = {q.qw, q.qx, q.qy, q.qz};
    for (int k = 0; k < 3; ++k) results[k] = pose(k, 3);
    for (int k = 0; k < 4; ++k) results[3 + k] = static_cast<T>(values[k]);
  }
}

nb::object forward_batch(const Arm& arm, const Configurations& q, nb::handle base, nb::handle tool,
                         PoseLayout layout, nb::handle out, int threads) {
  const bool matrix = layout == PoseLayout::matrix;
  const RowPoses bases(base, "base", q.count()), tools(tool, "tool", q.count());
  const bool replaced = bases.given() || tools.given();
  OutputArray results(out, "out", matrix ? q.shape({4, 4}) : q.shape({7}), q.real(), matrix);
  BatchOptions options;
  options.layout = layout;
  options.threads = threads;
  const auto batch = [&]<class T>(T, const auto& configurations, auto poses,
                                  const BatchOptions& with) {
    if (!replaced) return batch_forward<T>(arm, configurations, poses, with);
    Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> scratch(matrix ? 0 : 16, q.count());
    auto matrices = columns(matrix ? poses.data() : scratch.data(), 16, q.count());
    BatchOptions as_matrices = with;
    as_matrices.layout = PoseLayout::matrix;
    const BatchResult result = batch_forward<T>(arm, configurations, matrices, as_matrices);
    replace_ends(arm, bases, tools, matrices.data(), q.count());
    if (!matrix) write_position_quaternions(matrices.data(), poses.data(), q.count());
    return result;
  };
  run(arm, q, results, size(layout), options, batch);
  return results.finish();
}

nb::object forward(const Arm& arm, nb::handle q, nb::handle base, nb::handle tool,
                   nb::handle layout_name, nb::handle out, nb::handle threads) {
  const Configurations configurations(arm, q, "q", true);
  const PoseLayout layout = Value<PoseLayout>::from(layout_name, "layout");
  const int thread_count = threads_from(threads);
  check_apart(out, q, "q");
  check_apart(out, base, "base");
  check_apart(out, tool, "tool");
  const bool plain = base.is_none() && tool.is_none() && layout == PoseLayout::matrix;
  if (!plain || !configurations.one() || configurations.real() == Real::float32) {
    return forward_batch(arm, configurations, base, tool, layout, out, thread_count);
  }
  const Pose pose = forward_kinematics(arm, configurations.row(0));
  if (out.is_none()) return Value<Pose>::to(pose);
  const Index shape[] = {4, 4};
  OutputArray array(out, "out", shape, Real::float64);
  write_pose(pose, array.data());
  return array.finish();
}

nb::object links(const Arm& arm, nb::handle q, nb::handle layout_name, nb::handle out,
                 nb::handle threads) {
  const Configurations configurations(arm, q, "q", true);
  BatchOptions options;
  options.layout = Value<PoseLayout>::from(layout_name, "layout");
  options.threads = threads_from(threads);
  check_apart(out, q, "q");
  const bool matrix = options.layout == PoseLayout::matrix;
  const Index count = static_cast<Index>(arm.joints().size()) + 1;
  OutputArray results(
      out, "out", matrix ? configurations.shape({count, 4, 4}) : configurations.shape({count, 7}),
      configurations.real(), matrix);
  const auto batch = [&]<class T>(T, const auto& from, auto poses, const BatchOptions& with) {
    return batch_link_poses<T>(arm, from, poses, with);
  };
  run(arm, configurations, results, count * size(options.layout), options, batch);
  return results.finish();
}

nb::object jacobian_of(const Arm& arm, nb::handle q, nb::handle frame, nb::handle out,
                       nb::handle threads) {
  const Configurations configurations(arm, q, "q", true);
  BatchOptions options;
  options.frame = Value<Frame>::from(frame, "frame");
  options.threads = threads_from(threads);
  check_apart(out, q, "q");
  OutputArray results(out, "out", configurations.shape({6, arm.dof()}), configurations.real(),
                      true);
  if (configurations.one() && configurations.real() == Real::float64) {
    jacobian(arm, configurations.row(0), Eigen::Map<Jacobian>(results.data(), 6, arm.dof()),
             options.frame);
    return results.finish();
  }
  const auto batch = [&]<class T>(T, const auto& from, auto jacobians, const BatchOptions& with) {
    Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> no_poses(16, 0);
    return batch_jacobian<T>(arm, from, jacobians, no_poses, with);
  };
  run(arm, configurations, results, 6 * arm.dof(), options, batch);
  return results.finish();
}

nb::object manipulability(const Arm& arm, nb::handle q, nb::handle out, nb::handle threads) {
  const Configurations configurations(arm, q, "q", true);
  BatchOptions options;
  options.threads = threads_from(threads);
  check_apart(out, q, "q");
  OutputArray results(out, "out", configurations.shape({}), configurations.real());
  const auto batch = [&]<class T>(T, const auto& from, auto values, const BatchOptions& with) {
    return batch_manipulability<T>(arm, from, values, with);
  };
  run(arm, configurations, results, 1, options, batch);
  const nb::object values = results.finish();
  return configurations.one() && out.is_none() ? values[nb::make_tuple()] : values;
}

/// Of the dtype of `out`, float64 without one: stubs.py declares it.
constexpr const char* real_array = "numpy.typing.NDArray[_Real]";

Signature batch_signature(const char* name, const char* returns, const char* summary) {
  Signature signature(name, returns, summary);
  signature.takes_arm().takes(
      "q", array_like,
      std::string(configurations_doc) +
          " float32 is computed in float32; all else in float64. Where a row of a batch is "
          "not finite, neither are its results.");
  return signature;
}

void takes_layout(Signature& signature) {
  signature.takes("layout", Value<PoseLayout>::type(),
                  "`matrix`: 4 x 4; `position_quaternion`: x y z qw qx qy qz, qw >= 0.",
                  "'matrix'");
}

void takes_out(Signature& signature, const char* memory) {
  signature
      .takes("out", std::string(real_array) + " | None",
             std::string("Array for the result, of its shape and dtype (float32 for a q of "
                         "float32), with any strides, apart from the arguments. ") +
                 memory,
             "None")
      .member<&BatchOptions::threads>();
}

constexpr const char* as_returned =
    "An array that this function has returned is filled without another pass.";

}  // namespace

void bind_kinematics(nb::module_& m) {
  Signature fk = batch_signature("forward_kinematics", real_array,
                                 "Returns the poses of the tool, world_T_tool (Dellaert, *Serial "
                                 "Link Manipulators*, eq. 1.1).");
  fk.keywords()
      .takes("base", std::string(array_like) + " | None",
             "Pose of link 0 in the world, in place of the arm's: (4, 4), or (N, 4, 4), one for "
             "each configuration.",
             "None")
      .takes("tool", std::string(array_like) + " | None",
             "Pose of the tool in the last link, in place of the arm's, likewise.", "None");
  takes_layout(fk);
  takes_out(fk, as_returned);
  fk.returns("(4, 4), or (..., 4, 4); (..., 7) for the other layout.");
  define_on_arm(m, &forward, fk, nb::arg("arm"), nb::arg("q"), nb::kw_only(),
                nb::arg("base") = nb::none(), nb::arg("tool") = nb::none(),
                nb::arg("layout") = "matrix", nb::arg("out") = nb::none(), nb::arg("threads") = 0);

  Signature poses =
      batch_signature("link_poses", real_array,
                      "Returns the poses of all links in the world, from link 0 (the base) to the "
                      "last. The tool's is the last one times arm.tool.");
  takes_layout(poses.keywords());
  takes_out(poses, as_returned);
  poses.returns("(m + 1, 4, 4) for m joints, mimic joints included, or (..., m + 1, 4, 4).");
  define_on_arm(m, &links, poses, nb::arg("arm"), nb::arg("q"), nb::kw_only(),
                nb::arg("layout") = "matrix", nb::arg("out") = nb::none(), nb::arg("threads") = 0);

  Signature j = batch_signature("jacobian", real_array,
                                "Returns the Jacobian: rows [vx vy vz wx wy wz], a column for each "
                                "coordinate, in m and rad per unit of it (Dellaert, eq. 1.4).");
  j.choice<Frame>("frame", "", "'base'").keywords();
  takes_out(j, as_returned);
  j.returns("(6, n), or (..., 6, n).");
  define_on_arm(m, &jacobian_of, j, nb::arg("arm"), nb::arg("q"), nb::arg("frame") = "base",
                nb::kw_only(), nb::arg("out") = nb::none(), nb::arg("threads") = 0);

  Signature w = batch_signature(
      "manipulability", (std::string("float | ") + real_array).c_str(),
      "Returns Yoshikawa's manipulability sqrt(det(J J^T)) of the rows of the Jacobian that "
      "default_task() has: x, y and theta of a planar arm, all six of another; 0 for fewer joints. "
      "manipulability_gradient() takes other rows.");
  takes_out(w.keywords(), "");
  w.returns("A number, or an array of the batch's shape.");
  define_on_arm(m, &manipulability, w, nb::arg("arm"), nb::arg("q"), nb::kw_only(),
                nb::arg("out") = nb::none(), nb::arg("threads") = 0);
}

}  // namespace beeline::python
