#pragma once

#include <span>
#include <vector>

#include <beeline/collision/internal/joint_tube.h>
#include <beeline/internal/thread_scratch.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The Bernstein coefficients of the coordinates' motion over a part of an interval between two
/// samples, (6, n): a coordinate's values are weighted means of its column (Farin, "Curves and
/// Surfaces for CAGD", 2002, chapter 5).
using BernsteinCoefficients = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Computes the coefficients of the motion from sample k to the next (see Interpolation).
void set_bernstein_coefficients(const Trajectory& trajectory, std::size_t k,
                                BernsteinCoefficients& coefficients);

/// Computes a bound of the rounding of these coefficients, and of the values that enclose()
/// computes of them, for each coordinate.
void set_coefficient_rounding(const BernsteinCoefficients& coefficients, Eigen::VectorXd& rounding);

/// Adds to such a bound what halve() adds to the rounding.
void add_halving_rounding(const BernsteinCoefficients& whole, Eigen::VectorXd& rounding);

/// Divides the motion at the middle of its time (de Casteljau).
void halve(const BernsteinCoefficients& whole, BernsteinCoefficients& first,
           BernsteinCoefficients& second);

/// The values of a tube: JointTube refers to them.
struct TubeValues {
  Eigen::VectorXd middle, half_motion, slack;

  explicit TubeValues(Eigen::Index n = 0)
      : middle(Eigen::VectorXd::Zero(n)),
        half_motion(Eigen::VectorXd::Zero(n)),
        slack(Eigen::VectorXd::Zero(n)) {}
  void resize(Eigen::Index n) {
    middle.resize(n);
    half_motion.resize(n);
    slack.resize(n);
  }
  JointTube tube() const { return {middle, half_motion, slack}; }
};

/// Computes a tube that contains the motion: about the line between its ends, along which the
/// coordinate that moves most sets the pace. The slack includes the rounding of the coefficients.
/// The tube has the motion's number of coordinates.
void enclose(const BernsteinCoefficients& motion, const Eigen::VectorXd& rounding,
             TubeValues& tube);

/// Computes a tube that contains two tubes, of the motion from `begin` to `middle` and from there
/// to `end`.
void enclose(const TubeValues& first, const TubeValues& second, const Configuration& begin,
             const Configuration& middle, const Configuration& end, TubeValues& tube);

/// Tubes around the parts of a trajectory into which halving its intervals divides it.
class MotionTubes {
 public:
  /// The trajectory has two samples or more.
  explicit MotionTubes(const Trajectory& trajectory);

  /// A range of intervals, from sample `first` to sample `last`.
  struct Range {
    std::size_t node = 0;  ///< index of its tube
    std::size_t first = 0, last = 0;

    bool is_interval() const { return last == first + 1; }
    std::size_t middle() const { return first + (last - first) / 2; }
    Range first_half() const { return {node + 1, first, middle()}; }
    /// The nodes are in the order of a depth-first search; m intervals have 2 m - 1 of them.
    Range second_half() const { return {node + 2 * (middle() - first), middle(), last}; }
  };
  Range all() const { return {0, 0, trajectory_->size() - 1}; }

  const TubeValues& values(const Range& range) const { return scratch_->nodes[range.node]; }
  const BernsteinCoefficients& coefficients(std::size_t k) const {
    return scratch_->coefficients[k];
  }
  const Eigen::VectorXd& rounding(std::size_t k) const { return scratch_->rounding[k]; }
  const Trajectory& trajectory() const { return *trajectory_; }

 private:
  /// Values of each interval and of each node. A longer motion has left more of them.
  struct Scratch {
    std::vector<BernsteinCoefficients> coefficients;
    std::vector<Eigen::VectorXd> rounding;  ///< set_coefficient_rounding()
    std::vector<TubeValues> nodes;

    bool is_small() const { return coefficients.size() <= 1000; }  // about 1 MB
  };
  void fill(const Range& range);

  const Trajectory* trajectory_;
  ThreadScratch<Scratch> scratch_;
};

}  // namespace beeline::internal
