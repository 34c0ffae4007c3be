#pragma once

#include <algorithm>
#include <deque>
#include <vector>

#include <beeline/certificate/clearance.h>
#include <beeline/certificate/internal/tube_proof.h>
#include <beeline/collision/internal/nearest_pair.h>
#include <beeline/internal/budget_meter.h>

namespace beeline::internal {

/// The search of prove_clearance(): depth first, in the order of time. A part of the motion is
/// tested for the pairs that the part around it did not prove, and halved for those that it does
/// not prove itself.
class ClearanceSearch {
 public:
  /// Proves that the pairs keep their clearance raised by `beyond`, m. Pairs that keep their
  /// clearance everywhere within the limits may be nearer than the raised one: they are searched if
  /// `beyond` is above 0, unless `only_counted`.
  ClearanceSearch(const CollisionBodies& bodies, const MotionTubes& tubes,
                  const ClearanceOptions& options, BudgetMeter& budget, double beyond = 0,
                  bool only_counted = false);
  ClearanceSearch(const ClearanceSearch&) = delete;  // tree_search_ refers to other members
  ClearanceSearch& operator=(const ClearanceSearch&) = delete;

  /// A part of an interval between two samples, from time `from` to `to`, and its second half.
  struct Part {
    BernsteinCoefficients coefficients, second_half;
    double from = 0, to = 0;
    Eigen::VectorXd rounding = {};  ///< of the coefficients: set_coefficient_rounding()

    double middle() const { return from + (to - from) / 2; }
    bool is_divisible() const { return middle() > from && middle() < to; }
  };

  /// Ends the search at the first part that is not proved, collision or not.
  ClearanceSearch& until_first_fault() {
    until_first_fault_ = true;
    return *this;
  }

  /// Lets these pairs keep other distances, see TubeProof::release().
  ClearanceSearch& release(std::span<const ReleasedPair> pairs) {
    tube_proof_.release(pairs);
    return *this;
  }

  /// Returns the pairs of bodies that are not proved to keep their clearance at a configuration.
  /// Once only, instead of run().
  std::vector<OpenPair> open_at(const Configuration& q);

  /// Searches the whole motion, some intervals of it, or a part of one. Once only.
  ClearanceProof run() { return run(tubes_.all()); }
  ClearanceProof run(const MotionTubes::Range& range);
  ClearanceProof run(const Part& part);

 private:
  /// Pairs in open_, from `begin` to `end`.
  struct Pairs {
    std::size_t begin = 0, end = 0;
  };

  struct Scratch {
    std::vector<OpenPair> open, queue;
    std::vector<std::uint32_t> nodes;
    std::deque<Part> parts;
    TubeValues tube;

    bool is_small() const { return std::max(open.capacity(), queue.capacity()) <= 100'000; }
  };

  /// Pairs of nodes and groups are divided where that helps, or all down to bodies.
  enum class Nodes { as_needed, all };

  ClearanceProof finished() const;
  void add_all_pairs();
  void search(const MotionTubes::Range& range, Pairs pairs);
  void search_part(std::size_t level, Pairs pairs);
  void search_halves(std::size_t level, Pairs pairs);
  Pairs test(const JointTube& tube, Pairs pairs, Nodes nodes = Nodes::as_needed);
  void test_queue(Nodes nodes);
  bool is_small(Pairs pairs) const;
  void decide(const Part& part, Pairs pairs);
  void decide_at(double time, const Part& part, Pairs pairs);

  const CollisionBodies& bodies_;
  const MotionTubes& tubes_;
  const ClearanceOptions& options_;
  BudgetMeter& budget_;
  double beyond_;
  bool only_counted_;
  bool until_first_fault_ = false;
  TubeProof tube_proof_;
  ThreadScratch<Scratch> scratch_;
  std::vector<OpenPair>& open_;   ///< a stack
  std::vector<OpenPair>& queue_;  ///< pairs to be tested over the present tube
  TubeProof::TreeSearch tree_search_;
  std::deque<Part>& parts_;  ///< the part that is searched, and those around it, at least one
  TubeValues& tube_;
  ClearanceProof proof_;
  bool ended_ = false;
  std::size_t undecided_parts_ = 0;
};

/// Whether the whole motion is where the model's apart_pairs keep their clearance: it is within the
/// position limits. The coefficients bound it, and their rounding is far less than the margin.
bool keeps_apart(const CollisionBodies& bodies, const MotionTubes& tubes);

/// ClearanceProof::pairs of a motion.
std::size_t counted_pairs(const CollisionModel& model, const MotionTubes& tubes);

/// Whether apart_pairs count at all configurations of a motion: it leaves the limits somewhere.
ApartPairs apart_pairs_of(const CollisionModel& model, const MotionTubes& tubes);

/// Returns the motion that is examined: matched_to() the model's arm, and a second at rest where
/// the trajectory has one sample. Empty where that is the trajectory as it is. Throws Error for a
/// trajectory without samples, and as check_trajectory() and matched_to() do.
Trajectory adapted_motion(const CollisionModel& model, const Trajectory& trajectory);

}  // namespace beeline::internal
