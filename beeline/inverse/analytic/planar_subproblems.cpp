#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/inverse/analytic/planar_subproblems.h>
#include <beeline/math/minimum_norm.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

using Complex = std::complex<double>;
using Candidates = std::vector<PlanarCandidate>;

/// The revolute joints that precede a prismatic joint and therefore rotate its direction.
enum class RotatedBy { none, first, all };

/// The equation J_1 ... J_n p = r p + t. Revolute joint k, numbered among the revolute joints, has
/// its axis at c_k and rotates by rho_k, a complex number of modulus 1; rho_1 rho_2 ... = r.
class PlanarChain {
 public:
  PlanarChain(const std::vector<PlanarJoint>& joints, Complex r, Complex t)
      : joints_(joints), r_(r), t_(t), size_(std::abs(t)) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      (joints[i].revolute ? revolute_ : prismatic_).push_back(i);
      if (joints[i].revolute) size_ += std::abs(joints[i].axis);
    }
  }

  Candidates candidates() const {
    switch (revolute_.size()) {
      case 0:
        return {with_displacements({zero(), false}, t_)};
      case 1:
        return {one_revolute()};
      case 2:
        return prismatic_.empty() ? two_revolute() : two_revolute_one_prismatic();
      default:
        return three_revolute();
    }
  }

 private:
  Complex axis(std::size_t number) const { return joints_[revolute_[number]].axis; }
  Configuration zero() const {
    return Configuration::Zero(static_cast<Eigen::Index>(joints_.size()));
  }
  /// Whether a length is a rounding error: below a thousand units in the last place of the lengths
  /// from which it is computed.
  bool vanishes(double length) const { return length <= 1e-13 * size_; }

  double preferred(std::size_t joint) const { return joints_[joint].preferred.value_or(0); }

  /// Sets revolute joint `number` so that it rotates the plane by arg(rho).
  void rotate(Configuration& q, std::size_t number, Complex rho) const {
    const std::size_t joint = revolute_[number];
    q[static_cast<Eigen::Index>(joint)] =
        nearest_angle(joints_[joint].sign * std::arg(rho), preferred(joint));
  }

  /// Sets revolute joints for which only the sum of angles is determined, arg(rho). The difference
  /// to their preferred values is divided equally, among the joints without a preferred value if
  /// there are any.
  void rotate_together(PlanarCandidate& candidate, const std::vector<std::size_t>& numbers,
                       Complex rho) const {
    double difference = std::arg(rho);
    std::size_t indifferent = 0;
    for (const std::size_t number : numbers) {
      difference -= joints_[revolute_[number]].sign * preferred(revolute_[number]);
      indifferent += joints_[revolute_[number]].preferred ? 0 : 1;
    }
    difference = wrap_angle(difference);
    for (const std::size_t number : numbers) {
      const PlanarJoint& joint = joints_[revolute_[number]];
      double fraction = 1.0 / static_cast<double>(numbers.size());
      if (indifferent > 0) {
        fraction = joint.preferred ? 0 : 1.0 / static_cast<double>(indifferent);
      }
      candidate.q[static_cast<Eigen::Index>(revolute_[number])] =
          preferred(revolute_[number]) + joint.sign * fraction * difference;
    }
    candidate.continuum = true;
  }

  /// Solves the prismatic joints from sum q_k g_k = translation, with g_k their rotated directions.
  /// Of several solutions, it selects the one nearest to the preferred values (least norm).
  PlanarCandidate with_displacements(PlanarCandidate candidate, Complex translation) const {
    if (prismatic_.empty()) return candidate;
    Eigen::Matrix2Xd directions(2, prismatic_.size());
    for (std::size_t k = 0; k < prismatic_.size(); ++k) {
      const Complex direction = joints_[prismatic_[k]].axis;
      const Complex g = rotated_by(prismatic_[k]) == RotatedBy::none ? direction : r_ * direction;
      directions.col(static_cast<Eigen::Index>(k)) << g.real(), g.imag();
      translation -= g * preferred(prismatic_[k]);
    }
    constexpr double parallel = 1e-12;  // half the angle below which directions are parallel
    const MinimumNormSolution change = minimum_norm_solution(
        directions, Eigen::Vector2d(translation.real(), translation.imag()), parallel);
    for (std::size_t k = 0; k < prismatic_.size(); ++k) {
      candidate.q[static_cast<Eigen::Index>(prismatic_[k])] =
          preferred(prismatic_[k]) + change.x[static_cast<Eigen::Index>(k)];
    }
    if (change.rank < directions.cols()) candidate.continuum = true;
    return candidate;
  }

  RotatedBy rotated_by(std::size_t prismatic) const {
    const auto before = std::count_if(revolute_.begin(), revolute_.end(),
                                      [&](std::size_t revolute) { return revolute < prismatic; });
    if (before == 0) return RotatedBy::none;
    return static_cast<std::size_t>(before) == revolute_.size() ? RotatedBy::all : RotatedBy::first;
  }

  /// rho_1 = r, and t = (1 - r) c_1 + displacements.
  PlanarCandidate one_revolute() const {
    PlanarCandidate candidate{zero(), false};
    rotate(candidate.q, 0, r_);
    return with_displacements(candidate, t_ - (1.0 - r_) * axis(0));
  }

  /// Without prismatic joints, goal() = rho_1 link().
  Complex goal() const { return t_ - axis(0) + r_ * axis(1); }
  Complex link() const { return axis(1) - axis(0); }

  /// Sets rho_1 to rotate `from` to `to`, and rho_2 = r / rho_1. If a vector vanishes, only the
  /// product matters.
  PlanarCandidate with_rotations(PlanarCandidate candidate, Complex from, Complex to) const {
    if (vanishes(std::abs(from)) || vanishes(std::abs(to))) {
      rotate_together(candidate, {0, 1}, r_);
      return candidate;
    }
    rotate(candidate.q, 0, to / from);
    rotate(candidate.q, 1, r_ * from / to);
    return candidate;
  }

  Candidates two_revolute() const { return {with_rotations({zero(), false}, link(), goal())}; }

  Candidates two_revolute_one_prismatic() const {
    const std::size_t prismatic = prismatic_[0];
    const RotatedBy by = rotated_by(prismatic);
    const Complex direction = joints_[prismatic].axis;
    const Complex d = by == RotatedBy::all ? r_ * direction : direction;
    // Between the revolute joints: goal = rho_1 (link + q d). Otherwise: goal - q d = rho_1 link.
    const bool between = by == RotatedBy::first;
    const Complex start = between ? link() : goal();
    const Complex step = between ? d : -d;
    const double radius = std::abs(between ? goal() : link());
    Candidates result;
    for (const double q : line_circle_intersections(start, step, radius)) {
      PlanarCandidate candidate{zero(), false};
      candidate.q[static_cast<Eigen::Index>(prismatic)] = q;
      const Complex end = start + q * step;
      result.push_back(between ? with_rotations(candidate, end, goal())
                               : with_rotations(candidate, link(), end));
    }
    return result;
  }

  /// Returns all q with |start + q step| = radius, |step| = 1: two, or one if the line is tangent
  /// to the circle. If the line misses the circle, returns the q of the point nearest to the
  /// centre.
  std::vector<double> line_circle_intersections(Complex start, Complex step, double radius) const {
    const Complex along = std::conj(step) * start;
    const double distance = std::abs(along.imag());
    if (radius <= distance || vanishes(radius - distance)) return {-along.real()};
    const double half_chord = std::sqrt((radius - distance) * (radius + distance));
    return {-along.real() - half_chord, -along.real() + half_chord};
  }

  /// b = rho_1 (u + rho_2 v) with b = t + r c_3 - c_1, u = c_2 - c_1, v = c_3 - c_2: a triangle.
  Candidates three_revolute() const {
    const Complex b = t_ + r_ * axis(2) - axis(0), u = link(), v = axis(2) - axis(1);
    const double lu = std::abs(u), lv = std::abs(v), lb = std::abs(b);
    if (vanishes(lu) || vanishes(lv) || vanishes(lb)) return {degenerate_triangle(b, u, v)};
    PlanarCandidate candidate{zero(), false};
    Candidates result;
    for (const double elbow : elbow_angles(lu, lv, lb)) {
      const Complex second = std::polar(1.0, elbow + std::arg(u / v));
      const Complex first = b / (u + second * v);
      rotate(candidate.q, 0, first);
      rotate(candidate.q, 1, second);
      rotate(candidate.q, 2, r_ / (first * second));
      result.push_back(candidate);
    }
    return result;
  }

  /// Returns the solution if a side of the triangle vanishes: two axes coincide, or the third axis
  /// returns to the first. Only the sum of the other angles is then determined.
  PlanarCandidate degenerate_triangle(Complex b, Complex u, Complex v) const {
    PlanarCandidate candidate{zero(), false};
    const auto direction_to = [](Complex to, Complex from) {
      return std::abs(to) > 0 ? to / from / std::abs(to / from) : Complex(1);
    };
    if (vanishes(std::abs(u)) && vanishes(std::abs(v))) {
      rotate_together(candidate, {0, 1, 2}, r_);
    } else if (vanishes(std::abs(v))) {
      const Complex first = direction_to(b, u);
      rotate(candidate.q, 0, first);
      rotate_together(candidate, {1, 2}, r_ / first);
    } else if (vanishes(std::abs(u))) {
      const Complex both = direction_to(b, v);
      rotate_together(candidate, {0, 1}, both);
      rotate(candidate.q, 2, r_ / both);
    } else {
      const Complex folded = -u / v;
      rotate(candidate.q, 1, folded);
      rotate_together(candidate, {0, 2}, r_ / folded);
    }
    return candidate;
  }

  /// Returns the angles between the links u and v for which the end is at distance b, by the
  /// half-angle form of the law of cosines. This form keeps its digits near the stretched and the
  /// folded arm.
  std::vector<double> elbow_angles(double u, double v, double b) const {
    const double to_stretched = u + v - b;
    const double to_folded = b - std::abs(u - v);
    if (to_stretched <= 0 || vanishes(to_stretched)) return {0};
    if (to_folded <= 0 || vanishes(to_folded)) return {std::numbers::pi};
    const double elbow = 2 * std::atan2(std::sqrt(to_stretched * (u + v + b)),
                                        std::sqrt(to_folded * (b + std::abs(u - v))));
    return {elbow, -elbow};
  }

  const std::vector<PlanarJoint>& joints_;
  Complex r_, t_;
  double size_;  ///< sum of the lengths in the equation, metres
  std::vector<std::size_t> revolute_, prismatic_;
};

}  // namespace

std::vector<PlanarCandidate> planar_candidates(const std::vector<PlanarJoint>& joints,
                                               std::complex<double> rotation,
                                               std::complex<double> translation) {
  return PlanarChain(joints, rotation, translation).candidates();
}

}  // namespace beeline::internal
