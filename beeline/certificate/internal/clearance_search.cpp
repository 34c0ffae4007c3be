#include <algorithm>
#include <limits>

#include <beeline/certificate/internal/clearance_search.h>

namespace beeline::internal {
namespace {

using With = OpenPair::With;

/// The coordinates at the middle of the time of a motion: its Bernstein polynomials at 1/2.
void set_middle(const BernsteinCoefficients& b, Eigen::VectorXd& middle) {
  middle = (b.row(0) + b.row(5) + 5 * (b.row(1) + b.row(4)) + 10 * (b.row(2) + b.row(3))) / 32;
}

}  // namespace

bool keeps_apart(const CollisionBodies& bodies, const MotionTubes& tubes) {
  if (bodies.apart_pairs.empty()) return true;
  for (std::size_t k = 0; k + 1 < tubes.trajectory().size(); ++k) {
    const BernsteinCoefficients& coefficients = tubes.coefficients(k);
    for (Eigen::Index i = 0; i < coefficients.cols(); ++i) {
      if (!(coefficients.col(i).minCoeff() >= bodies.apart_lower[i] &&
            coefficients.col(i).maxCoeff() <= bodies.apart_upper[i])) {
        return false;
      }
    }
  }
  return true;
}

std::size_t counted_pairs(const CollisionModel& model, const MotionTubes& tubes) {
  return model.pair_count() + (keeps_apart(model.bodies(), tubes) ? 0 : model.apart_count());
}

ApartPairs apart_pairs_of(const CollisionModel& model, const MotionTubes& tubes) {
  return keeps_apart(model.bodies(), tubes) ? ApartPairs::outside_limits : ApartPairs::count;
}

ClearanceSearch::ClearanceSearch(const CollisionBodies& bodies, const MotionTubes& tubes,
                                 const ClearanceOptions& options, BudgetMeter& budget,
                                 double beyond, bool only_counted)
    : bodies_(bodies),
      tubes_(tubes),
      options_(options),
      budget_(budget),
      beyond_(beyond),
      only_counted_(only_counted),
      tube_proof_(bodies, tubes.values(tubes.all()), beyond),
      open_(scratch_->open),
      queue_(scratch_->queue),
      tree_search_{.nodes = scratch_->nodes, .open = open_, .obstacles = queue_},
      parts_(scratch_->parts),
      tube_(scratch_->tube) {
  open_.clear();
  queue_.clear();
  scratch_->nodes.clear();
  if (parts_.empty()) parts_.emplace_back();
  tube_.resize(bodies.arm.dof());
  proof_.status = ClearanceStatus::clear;  // until a part is found that is not
  proof_.least_distance = std::numeric_limits<double>::infinity();
}

ClearanceProof ClearanceSearch::run(const MotionTubes::Range& range) {
  add_all_pairs();
  search(range, {0, open_.size()});
  return finished();
}

ClearanceProof ClearanceSearch::run(const Part& part) {
  add_all_pairs();
  parts_.front() = part;
  search_part(0, {0, open_.size()});
  return finished();
}

std::vector<OpenPair> ClearanceSearch::open_at(const Configuration& q) {
  add_all_pairs();
  const Configuration none = Configuration::Zero(q.size());
  const Pairs open = test({q, none, none}, {0, open_.size()}, Nodes::all);
  return {open_.begin() + static_cast<std::ptrdiff_t>(open.begin), open_.end()};
}

ClearanceProof ClearanceSearch::finished() const {
  ClearanceProof proof = proof_;
  if (!budget_.complete() && proof.status != ClearanceStatus::collides) {
    proof.status = status_of<ClearanceStatus>(budget_.ending());
  }
  return proof;
}

void ClearanceSearch::add_all_pairs() {
  for (std::uint32_t i = 0; i < bodies_.group_pairs.size(); ++i) {
    const auto [first, second, begin, end] = bodies_.group_pairs[i];
    const bool is_of_bodies =
        bodies_.groups[first].is_single() && bodies_.groups[second].is_single();
    open_.push_back({.with = is_of_bodies ? With::link : With::group,
                     .body = first,
                     .other = second,
                     .group_pair = i});
  }
  if ((beyond_ > 0 && !only_counted_) || !keeps_apart(bodies_, tubes_)) {
    for (const auto& pair : bodies_.apart_pairs) {
      open_.push_back({.with = With::link, .body = pair.first, .other = pair.second});
    }
  } else if (!bodies_.apart_pairs.empty()) {  // proved to keep the clearance, but not more
    proof_.least_distance = bodies_.options.clearance;
  }
  for (const std::uint32_t whole : bodies_.link_groups) {
    if (bodies_.groups[whole].frame == 0) continue;  // link 0 does not move
    if (!bodies_.tree.empty()) open_.push_back({.with = With::node, .body = whole, .other = 0});
  }
  for (std::uint32_t i = 0; i < bodies_.link_bodies.size(); ++i) {
    if (!CollisionBodies::meets_obstacles(bodies_.link_bodies[i])) continue;
    for (std::size_t k = bodies_.finite_obstacles; k < bodies_.obstacle_bodies.size(); ++k) {
      if (bodies_.allowed(bodies_.link_bodies[i], bodies_.obstacle_bodies[k].obstacle)) continue;
      open_.push_back({.with = With::obstacle, .body = i, .other = static_cast<std::uint32_t>(k)});
    }
  }
}

void ClearanceSearch::search(const MotionTubes::Range& range, Pairs pairs) {
  const Pairs open = test(tubes_.values(range).tube(), pairs);
  if (open.begin < open.end && !ended_) {
    if (range.is_interval()) {
      const std::vector<double>& times = tubes_.trajectory().times;
      parts_.front().coefficients = tubes_.coefficients(range.first);
      parts_.front().from = times[range.first];
      parts_.front().to = times[range.last];
      parts_.front().rounding = tubes_.rounding(range.first);
      search_halves(0, open);
    } else {
      search(range.first_half(), open);
      if (!ended_) search(range.second_half(), open);
    }
  }
  open_.resize(open.begin);
}

void ClearanceSearch::search_halves(std::size_t level, Pairs pairs) {
  if (parts_.size() == level + 1) parts_.emplace_back();
  Part& whole = parts_[level];
  Part& half = parts_[level + 1];
  const double middle = whole.middle();
  half.rounding = whole.rounding;
  add_halving_rounding(whole.coefficients, half.rounding);
  halve(whole.coefficients, half.coefficients, whole.second_half);
  half.from = whole.from;
  half.to = middle;
  search_part(level + 1, pairs);
  if (ended_) return;
  half.coefficients = whole.second_half;
  half.from = middle;
  half.to = whole.to;
  search_part(level + 1, pairs);
}

void ClearanceSearch::search_part(std::size_t level, Pairs pairs) {
  const Part& part = parts_[level];
  const bool is_last = !part.is_divisible();
  enclose(part.coefficients, part.rounding, tube_);
  const Pairs open = test(tube_.tube(), pairs, is_last ? Nodes::all : Nodes::as_needed);
  if (open.begin < open.end && !ended_) {
    if (is_last || is_small(open)) {
      decide(part, open);
    } else {
      search_halves(level, open);
    }
  }
  open_.resize(open.begin);
}

/// Returns the pairs that the tube does not prove.
ClearanceSearch::Pairs ClearanceSearch::test(const JointTube& tube, Pairs pairs, Nodes nodes) {
  Pairs left{open_.size(), open_.size()};
  if (pairs.begin == pairs.end) return left;
  ++proof_.parts;
  if (budget_.ended()) {
    ended_ = true;
    return left;
  }
  tube_proof_.place(tube);
  tree_search_.all = nodes == Nodes::all;
  for (std::size_t i = pairs.begin; i < pairs.end;) {
    if (open_[i].with != With::node) {
      queue_.assign(1, open_[i++]);
    } else {  // all nodes of a group stand together
      const std::uint32_t group = open_[i].body;
      for (; i < pairs.end && open_[i].with == With::node && open_[i].body == group; ++i) {
        tree_search_.nodes.push_back(open_[i].other);
      }
      queue_.clear();
      tube_proof_.search_tree(group, tree_search_);
    }
    test_queue(nodes);
  }
  proof_.least_distance = std::min(proof_.least_distance, tree_search_.least_distance);
  left.end = open_.size();
  return left;
}

/// Tests the pairs of bodies and groups in the queue.
void ClearanceSearch::test_queue(Nodes nodes) {
  while (!queue_.empty()) {
    OpenPair pair = queue_.back();
    queue_.pop_back();
    const TubeProof::Bound bound = tube_proof_.bound(pair);
    if (bound.proves()) {
      proof_.least_distance = std::min(proof_.least_distance, bound.distance);
    } else if (pair.with == With::group &&
               (nodes == Nodes::all || tube_proof_.is_coarse_group_pair(pair))) {
      tube_proof_.divide_group_pair(pair, queue_);
    } else {
      open_.push_back(pair);
    }
  }
}

bool ClearanceSearch::is_small(Pairs pairs) const {
  return std::all_of(open_.begin() + static_cast<std::ptrdiff_t>(pairs.begin),
                     open_.begin() + static_cast<std::ptrdiff_t>(pairs.end),
                     [&](const OpenPair& pair) {
                       if (!pair.is_of_bodies()) return false;
                       return tube_proof_.displacement(pair) <=
                              tube_proof_.smallest_motion(pair, options_.resolution);
                     });
}

/// Decides a part that can hardly be divided, at the middle of its time; the first part of the
/// motion at its start before. The pairs are of bodies.
void ClearanceSearch::decide(const Part& part, Pairs pairs) {
  const Trajectory& motion = tubes_.trajectory();
  if (part.from == motion.times.front()) {
    tube_.middle = motion.positions.front();
    decide_at(part.from, part, pairs);
  }
  if (proof_.status != ClearanceStatus::collides) {
    set_middle(part.coefficients, tube_.middle);
    decide_at(part.middle(), part, pairs);
  }
  constexpr std::size_t most_undecided = 10'000;
  if (++undecided_parts_ == most_undecided) ended_ = true;
}

/// Decides a part at a time of it, at which tube_.middle is the configuration.
void ClearanceSearch::decide_at(double time, const Part& part, Pairs pairs) {
  tube_.half_motion.setZero();
  tube_.slack.setZero();
  tube_proof_.place(tube_.tube());
  for (std::size_t i = pairs.begin; i < pairs.end; ++i) {
    const BodyDistance pair = tube_proof_.distance(open_[i]);
    const bool collides = tube_proof_.is_too_close(open_[i], pair);
    const bool is_first = proof_.status == ClearanceStatus::clear;
    const bool is_deeper = proof_.status == ClearanceStatus::collides &&
                           pair.lower - pair.clearance < proof_.pair.lower - proof_.pair.clearance;
    if (collides && (proof_.status != ClearanceStatus::collides || is_deeper)) {
      if (is_first) proof_.begin = part.from;
      proof_.status = ClearanceStatus::collides;
      proof_.pair = pair;
      proof_.time = time;
      ended_ = true;
    } else if (is_first) {
      proof_ = {.status = ClearanceStatus::not_decided,
                .pair = pair,
                .time = time,
                .begin = part.from,
                .end = part.to,
                .parts = proof_.parts};
      ended_ = until_first_fault_;
    }
  }
}

Trajectory adapted_motion(const CollisionModel& model, const Trajectory& trajectory) {
  check_trajectory(trajectory);
  if (trajectory.size() == 0) throw Error("the trajectory has no samples");
  const bool matches = trajectory.joint_names == model.bodies().joint_names;
  if (matches && trajectory.size() > 1) return {};
  Trajectory motion = matches ? trajectory : matched_to(model.arm(), trajectory);
  if (motion.size() > 1) return motion;
  const Configuration& q = motion.positions.front();
  return {motion.joint_names, {motion.times.front(), motion.times.front() + 1}, {q, q}, {}, {}};
}

}  // namespace beeline::internal
