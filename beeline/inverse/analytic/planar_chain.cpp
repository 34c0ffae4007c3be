#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/inverse/analytic/planar_chain.h>
#include <beeline/pose/angle.h>

namespace beeline {
namespace {

using Complex = std::complex<double>;
using Candidates = std::vector<PlanarCandidate>;

/// How a slide's direction is turned: by nothing, by the first turning joint, by all of them.
enum class Carried { not_at_all, by_first, by_all };

class PlanarChain {
 public:
  PlanarChain(const std::vector<PlanarJoint>& joints, Complex r, Complex t)
      : joints_(joints), r_(r), t_(t), size_(std::abs(t)) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      (joints[i].turns ? turns_ : slides_).push_back(i);
      if (joints[i].turns) size_ += std::abs(joints[i].place);
    }
  }

  Candidates candidates() const {
    switch (turns_.size()) {
      case 0:
        return {slides_alone({blank(), false}, t_)};
      case 1:
        return {one_turn()};
      case 2:
        return slides_.empty() ? two_turns() : two_turns_and_a_slide();
      default:
        return three_turns();
    }
  }

 private:
  Complex place(std::size_t turn) const { return joints_[turns_[turn]].place; }
  Configuration blank() const {
    return Configuration::Zero(static_cast<Eigen::Index>(joints_.size()));
  }
  /// Below this a length is rounding.
  bool vanishes(double length) const { return length <= 1e-13 * size_; }

  double preferred(std::size_t joint) const { return joints_[joint].preferred.value_or(0); }

  /// Sets a turning joint (numbered among these) so that it turns the plane by arg(rho).
  void turn(Configuration& q, std::size_t number, Complex rho) const {
    const std::size_t joint = turns_[number];
    q[static_cast<Eigen::Index>(joint)] =
        nearest_turn(joints_[joint].sign * std::arg(rho), preferred(joint));
  }

  /// Turning joints whose turns only count together: they turn by arg(rho) in all, each as little
  /// away from what it prefers as can be.
  void turn_together(PlanarCandidate& candidate, const std::vector<std::size_t>& numbers,
                     Complex rho) const {
    double left = std::arg(rho);
    std::size_t indifferent = 0;
    for (const std::size_t number : numbers) {
      left -= joints_[turns_[number]].sign * preferred(turns_[number]);
      indifferent += joints_[turns_[number]].preferred ? 0 : 1;
    }
    left = wrap_angle(left);
    for (const std::size_t number : numbers) {
      const PlanarJoint& joint = joints_[turns_[number]];
      double share = 1.0 / static_cast<double>(numbers.size());
      if (indifferent > 0) share = joint.preferred ? 0 : 1.0 / static_cast<double>(indifferent);
      candidate.q[static_cast<Eigen::Index>(turns_[number])] =
          preferred(turns_[number]) + joint.sign * share * left;
    }
    candidate.continuum = true;
  }

  /// The slides' part: sum of q_k g_k = rest, nearest to what is preferred.
  PlanarCandidate slides_alone(PlanarCandidate candidate, Complex rest) const {
    if (slides_.empty()) return candidate;
    Eigen::Matrix2Xd directions(2, slides_.size());
    for (std::size_t k = 0; k < slides_.size(); ++k) {
      const Complex g = carried(slides_[k]) == Carried::not_at_all ? joints_[slides_[k]].place
                                                                   : r_ * joints_[slides_[k]].place;
      directions.col(static_cast<Eigen::Index>(k)) << g.real(), g.imag();
      rest -= g * preferred(slides_[k]);
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(1e-12);
    decomposition.compute(directions);
    const Eigen::VectorXd moved = decomposition.solve(Eigen::Vector2d(rest.real(), rest.imag()));
    for (std::size_t k = 0; k < slides_.size(); ++k) {
      candidate.q[static_cast<Eigen::Index>(slides_[k])] =
          preferred(slides_[k]) + moved[static_cast<Eigen::Index>(k)];
    }
    if (decomposition.rank() < directions.cols()) candidate.continuum = true;
    return candidate;
  }

  Carried carried(std::size_t slide) const {
    const auto before = std::count_if(turns_.begin(), turns_.end(),
                                      [slide](std::size_t turning) { return turning < slide; });
    if (before == 0) return Carried::not_at_all;
    return static_cast<std::size_t>(before) == turns_.size() ? Carried::by_all : Carried::by_first;
  }

  /// t = (1 - r) c + what slides.
  PlanarCandidate one_turn() const {
    PlanarCandidate candidate{blank(), false};
    turn(candidate.q, 0, r_);
    return slides_alone(candidate, t_ - (1.0 - r_) * place(0));
  }

  /// Two turns rho_1 rho_2 = r about c_1 and c_2 make t - c_1 + r c_2 = rho_1 (c_2 - c_1).
  Complex goal() const { return t_ - place(0) + r_ * place(1); }
  Complex link() const { return place(1) - place(0); }

  /// rho_1 turns `from` to `to`, and rho_2 does the rest; both together where there is no lever.
  PlanarCandidate turned(PlanarCandidate candidate, Complex from, Complex to) const {
    if (vanishes(std::abs(from)) || vanishes(std::abs(to))) {
      turn_together(candidate, {0, 1}, r_);
      return candidate;
    }
    turn(candidate.q, 0, to / from);
    turn(candidate.q, 1, r_ * from / to);
    return candidate;
  }

  Candidates two_turns() const { return {turned({blank(), false}, link(), goal())}; }

  Candidates two_turns_and_a_slide() const {
    const std::size_t slide = slides_[0];
    const Carried by = carried(slide);
    const Complex d = by == Carried::by_all ? r_ * joints_[slide].place : joints_[slide].place;
    // Carried by the first: goal = rho_1 (link + q d). Otherwise: goal - q d = rho_1 link.
    const bool between = by == Carried::by_first;
    const Complex start = between ? link() : goal();
    const Complex step = between ? d : -d;
    const double radius = std::abs(between ? goal() : link());
    Candidates result;
    for (const double q : circle_crossings(start, step, radius)) {
      PlanarCandidate candidate{blank(), false};
      candidate.q[static_cast<Eigen::Index>(slide)] = q;
      const Complex moved = start + q * step;
      result.push_back(between ? turned(candidate, moved, goal())
                               : turned(candidate, link(), moved));
    }
    return result;
  }

  /// All q with |start + q step| = radius, |step| = 1: two, or one where the line touches the
  /// circle; where it misses, the q of the line's point nearest to the centre.
  std::vector<double> circle_crossings(Complex start, Complex step, double radius) const {
    const Complex seen = std::conj(step) * start;
    const double off = std::abs(seen.imag());
    if (radius <= off || vanishes(radius - off)) return {-seen.real()};
    const double half = std::sqrt((radius - off) * (radius + off));
    return {-seen.real() - half, -seen.real() + half};
  }

  /// b = rho_1 (u + rho_2 v) with b = t + r c_3 - c_1, u = c_2 - c_1, v = c_3 - c_2: a triangle.
  Candidates three_turns() const {
    const Complex b = t_ + r_ * place(2) - place(0), u = link(), v = place(2) - place(1);
    const double lu = std::abs(u), lv = std::abs(v), lb = std::abs(b);
    PlanarCandidate candidate{blank(), false};
    if (vanishes(lu) && vanishes(lv)) {
      turn_together(candidate, {0, 1, 2}, r_);
      return {candidate};
    }
    if (vanishes(lv)) {
      const Complex first = lb > 0 ? b / u / std::abs(b / u) : 1;
      turn(candidate.q, 0, first);
      turn_together(candidate, {1, 2}, r_ / first);
      return {candidate};
    }
    if (vanishes(lu)) {
      const Complex both = lb > 0 ? b / v / std::abs(b / v) : 1;
      turn_together(candidate, {0, 1}, both);
      turn(candidate.q, 2, r_ / both);
      return {candidate};
    }
    if (vanishes(lb)) {
      const Complex folded = -u / v;
      turn(candidate.q, 1, folded);
      turn_together(candidate, {0, 2}, r_ / folded);
      return {candidate};
    }
    Candidates result;
    for (const double elbow : elbow_angles(lu, lv, lb)) {
      const Complex second = std::polar(1.0, elbow + std::arg(u / v));
      const Complex first = b / (u + second * v);
      turn(candidate.q, 0, first);
      turn(candidate.q, 1, second);
      turn(candidate.q, 2, r_ / (first * second));
      result.push_back(candidate);
    }
    return result;
  }

  /// The angles between the links u and v that put the end at distance b: the half-angle form of
  /// the law of cosines, which keeps its digits near the stretched and the folded arm.
  std::vector<double> elbow_angles(double u, double v, double b) const {
    const double short_of_stretched = u + v - b;
    const double beyond_folded = b - std::abs(u - v);
    if (short_of_stretched <= 0 || vanishes(short_of_stretched)) return {0};
    if (beyond_folded <= 0 || vanishes(beyond_folded)) return {std::numbers::pi};
    const double elbow = 2 * std::atan2(std::sqrt(short_of_stretched * (u + v + b)),
                                        std::sqrt(beyond_folded * (b + std::abs(u - v))));
    return {elbow, -elbow};
  }

  const std::vector<PlanarJoint>& joints_;
  Complex r_, t_;
  double size_;  ///< the lengths that take part: what rounding is measured against
  std::vector<std::size_t> turns_, slides_;
};

}  // namespace

std::vector<PlanarCandidate> planar_candidates(const std::vector<PlanarJoint>& joints,
                                               std::complex<double> rotation,
                                               std::complex<double> translation) {
  return PlanarChain(joints, rotation, translation).candidates();
}

}  // namespace beeline
