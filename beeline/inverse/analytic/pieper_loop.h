#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <beeline/inverse/analytic/rigid_motion.h>
#include <beeline/model/internal/joint_axes.h>

namespace beeline::internal {

/// The loop-closure equation of a six-joint arm at its goal,
///     K_d J_d K_e J_e K_f J_f K_a J_a K_b J_b K_c J_c = I,
/// with constant motions K and joint motions J, each a rotation about z or a translation along z.
/// The product may start at any joint. It starts where the last three joints a, b, c are revolute
/// and their axes intersect in one point or are parallel (the conditions of Pieper, "The kinematics
/// of manipulators under computer control", 1968). Joints a and c then leave that point, or that
/// direction, unchanged. Two equations in joints d and f follow, with e eliminated: the canonical
/// subproblems of Paden and Kahan in one form (compare Elias & Wen, "IK-Geo", 2024).
struct PieperLoop {
  enum class Family { intersecting, parallel };
  Family family = Family::intersecting;
  std::array<int, 6> order{};           ///< the arm's joint numbers of d, e, f, a, b, c
  std::array<RigidMotion, 6> before{};  ///< K_d to K_c; the entry at `goal_index` is not used
  int goal_index = 0;               ///< 0 to 3: the index of the K that depends on the goal. It is
  RigidMotion tool{}, base{};       ///< tool * goal^-1 * base
  std::array<bool, 3> prismatic{};  ///< whether joints d, e, f are prismatic; e is revolute
  std::array<double, 6> sign{};     ///< joint angle or displacement = sign * q + offset
  std::array<double, 6> offset{};
  double sin_alpha[2] = {0, 0};  ///< intersecting axes: angles from axis a to b and from b to c
  double cos_alpha[2] = {1, 1};
  double height = 0;  ///< parallel axes: height of the origin of c above the origin of a, metres
  double size = 1;    ///< extent of the loop, metres; lengths are compared with it

  /// The unknown that one combination of the two equations does not contain, for every goal. The
  /// equations are b_i . w + a_i . u + k_i = 0, i = 0, 1, with u = (cos, sin) of joint d and w =
  /// (cos, sin) of joint f; a prismatic joint has (displacement, its square). With `first` = w the
  /// combination weight[0] (1) + weight[1] (2) has no u and gives w; equation `second` then gives
  /// u. With `first` = u the roles are exchanged. With `neither` a quartic has to be solved.
  enum class First { w, u, neither };
  First first = First::neither;
  double weight[2] = {0, 0};
  int second = 0;
};

/// Axes count as intersecting or parallel up to this sine of an angle, or distance over size.
/// Models read from text with ten digits pass. The resulting error of the solutions is below their
/// tolerance.
inline constexpr double special = 1e-10;

/// Returns the extent of an arm with these axes, metres: lengths are compared with it.
double size_of(const std::vector<JointAxis>& axes, const Pose& tool);

/// Returns the loop of a chain of six links, or nothing if no three consecutive axes intersect or
/// are parallel. Each link is revolute or prismatic and has a coordinate of its own. With
/// `world_T_tool` the loop serves this goal only, and PieperLoop::first may depend on it.
std::optional<PieperLoop> pieper_loop(const Chain& chain, const Pose* world_T_tool = nullptr);

/// Returns a description such as `three axes meet (joints 4, 5, 6)`. If virtual joints complete an
/// arm with `joints` below six, it is such as `three axes meet (joint 4 and 2 virtual at the
/// tool)`. With a locked coordinate of a longer arm, joints are numbered as in that arm.
std::string description(const PieperLoop& loop, int joints = 6,
                        std::optional<int> locked = std::nullopt);

}  // namespace beeline::internal
