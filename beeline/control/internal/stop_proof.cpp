#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/control/internal/stop_proof.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int max_parts = 4;           // of the line
constexpr double fine_bound = 4e-4;    // m, remainder of the bounds on a part of the line
constexpr std::size_t max_near = 256;  // pairs

/// m, by which a distance may exceed a clearance and count as equal. Bodies that are placed at
/// their clearance would else be undecided, and the arm could not leave.
constexpr double resolution = 1e-9;

/// m, to which distances are computed, unless a body may be at its clearance or below it.
constexpr double distance_tolerance = resolution / 10;

/// Number of pairs whose searches begin with their last ones: of clouds there are millions.
constexpr std::size_t max_starts = 4096;

}  // namespace

StopProof::StopProof(const CollisionBodies& bodies, double gain)
    : bodies_(&bodies),
      gain_(gain),
      pairs_(bodies),
      motion_(bodies.motion),
      placed_(bodies.link_bodies.size()),
      is_placed_(placed_.size()),
      last_separations_(pairs_.size()),
      starts_(std::min(max_starts, pairs_.size())),
      near_(std::min(max_near, pairs_.size())),
      line_(bodies.arm.dof()),
      line_end_(bodies.arm.dof()),
      part_line_(bodies.arm.dof()),
      part_start_(bodies.arm.dof()),
      framed_line_(Eigen::VectorXd::Constant(bodies.arm.dof(), nan)),
      framed_start_(framed_line_),
      zero_(Eigen::VectorXd::Zero(bodies.arm.dof())) {}

void StopProof::reset() {
  pairs_.reset();
  for (LastSeparation& last : last_separations_) last.step = 0;
  for (PairStart& start : starts_) start.search.count = 0;
  near_.clear();
}

void StopProof::begin_step(const ConfigurationRef& q) {
  pairs_.move_to(q);
  ++step_;
}

std::array<std::string_view, 2> StopProof::names(std::size_t index) const {
  const BodyPair& pair = pairs_.pair(index);
  const std::string& first = bodies_->name_of(bodies_->link_bodies[pair.first]);
  if (pair.is_obstacle) return {first, bodies_->name_of(bodies_->obstacle_bodies[pair.second])};
  return {first, bodies_->name_of(bodies_->link_bodies[pair.second])};
}

std::optional<std::size_t> StopProof::violated_pair() const {
  if (near_.empty()) return std::nullopt;
  if (too_many_) return near_[0].pair;
  const auto closest = std::min_element(
      near_.begin(), near_.end(), [](const auto& a, const auto& b) { return a.least < b.least; });
  if (closest->least < 0) return closest->pair;
  const auto fastest = std::min_element(
      near_.begin(), near_.end(),
      [this](const auto& a, const auto& b) { return damper_slack(a) < damper_slack(b); });
  if (damper_slack(*fastest) < 0) return fastest->pair;
  return std::nullopt;
}

void StopProof::set_frames(const ConfigurationRef& q, int part, int parts) {
  part_line_ = line_ / parts;
  part_start_ = q + part * part_line_;
  const bool same_start = part_start_ == framed_start_;
  if (same_start && part_line_ == framed_line_) return;
  framed_start_ = part_start_;
  framed_line_ = part_line_;
  motion_.set({part_start_, part_line_, zero_});
  if (!same_start) std::fill(is_placed_.begin(), is_placed_.end(), char{0});
}

bool StopProof::prove(const ConfigurationRef& q, const Eigen::VectorXd& line, double time,
                      Effort effort) {
  time_ = time;
  line_ = line;
  near_.clear();
  too_many_ = false;
  parts_ = 1;
  if (line_.isZero(0)) return true;
  if (!find_near_pairs(q)) return false;
  if (near_.empty() || prove_part(0, 1)) return true;
  parts_ = part_count();
  if (parts_ == 1) return false;
  for (NearPair& near : near_) {
    near.finished = near.least >= 0;
    if (!near.finished) near.least = std::numeric_limits<double>::infinity();
  }
  bool proved = true;
  for (int part = 0; part < parts_; ++part) {
    set_frames(q, part, parts_);
    proved = prove_part(part, parts_) && proved;
    if (!proved && effort == Effort::first_violation) return false;
  }
  return proved;
}

/// Returns the capsule around a link's body with its motion relative to a frame along the line.
MovingCapsule StopProof::capsule(std::uint32_t body, std::size_t from) const {
  const CollisionBodies::BodyGroup& group = bodies_->groups[body];
  const ChainMotion::TubeBounds bounds =
      motion_.bounds(pairs_.motions().reach(body), group.frame, from);
  const MovingCapsule moving = carried_by(motion_.frame(group.frame), group.capsule, bounds);
  return from == 0 ? moving : relative_to(motion_.frame(from), bounds, moving);
}

/// Bounds the distance by which the capsule moves, on the line or while the damper looks ahead,
/// whichever is more.
double StopProof::displacement(const MovingCapsule& moving) const {
  const double first_order = moving.velocity.norm() + moving.half_axis_velocity.norm() +
                             moving.angular.norm() * moving.at_middle.radius;
  return std::max(std::min(moving.bounds.displacement, first_order + moving.bounds.remainder),
                  first_order / (gain_ * time_));
}

/// Sets near_, the nearest pairs first. Returns false if there are too many.
bool StopProof::find_near_pairs(const ConfigurationRef& q) {
  pairs_.motions().set(q, line_);
  line_end_ = q + line_;
  const bool keeps_apart = bodies_->keeps_apart(q) && bodies_->keeps_apart(line_end_);
  const double factor = std::max(1.0, 1 / (gain_ * time_));
  bool has_frames = false;
  for (std::size_t i = 0; i < pairs_.groups().size(); ++i) {
    const PairGroup& group = pairs_.groups()[i];
    if (group.is_apart && keeps_apart) continue;
    const double farthest = factor * pairs_.motions().of(group.first, group.from);
    if (pairs_.least_excess(i) >= farthest) continue;
    if (!has_frames) set_frames(q, 0, 1);
    has_frames = true;
    const MovingCapsule moving = capsule(group.first, group.from);
    const double reach = displacement(moving);
    for (std::size_t k = group.begin; k < group.end; ++k) {
      if (!(pairs_.excess(k) >= reach)) add_if_near(k, moving, reach);
    }
  }
  std::sort(near_.begin(), near_.end(),
            [](const auto& a, const auto& b) { return a.excess < b.excess; });
  return !too_many_;
}

const ConvexBody& StopProof::placed(std::uint32_t body) {
  if (!is_placed_[body]) {
    placed_[body] = in_world(motion_, bodies_->link_bodies[body].carried);
    is_placed_[body] = 1;
  }
  return placed_[body];
}

const ConvexBody& StopProof::second_of(const BodyPair& pair) {
  return pair.is_obstacle ? bodies_->obstacle_bodies[pair.second].body : placed(pair.second);
}

std::size_t StopProof::frame_of_second(const BodyPair& pair) const {
  return pair.is_obstacle ? 0 : bodies_->link_bodies[pair.second].carried.frame;
}

/// Bounds the rounding of the pair's distance, m.
double StopProof::rounding(const BodyPair& pair) {
  const auto of_link = [&](std::uint32_t body) {
    const CollisionBodies::BodyGroup& group = bodies_->groups[body];
    return motion_.rounding(group.frame, group.magnitude);
  };
  return of_link(pair.first) + (pair.is_obstacle ? 0 : of_link(pair.second)) +
         support_rounding(placed(pair.first)) + support_rounding(second_of(pair));
}

/// Returns the separation of a pair at the start of the part, to a tolerance of its distance, m.
Separation StopProof::separate(std::size_t index, double tolerance) {
  const BodyPair& pair = pairs_.pair(index);
  const ConvexBody &first = placed(pair.first), &second = second_of(pair);
  Vector3 guess = last_separations_[index].step > 0 ? last_separations_[index].points.direction
                                                    : Vector3(second.centre - first.centre);
  if (guess.isZero(0)) guess = Vector3::UnitX();
  PairStart& start = starts_[index % starts_.size()];
  if (start.pair != index) start = {.pair = index};
  return separation(first, second, guess, tolerance, &start.search);
}

/// Whether the direction n from the first body to the second shows that the line keeps the
/// clearance and that the damper is satisfied. Sets `excess` to a lower bound of the distance
/// beyond the clearance at q.
bool StopProof::is_clear_along(const BodyPair& pair, const MovingCapsule& moving, const Vector3& n,
                               double& excess) {
  const BoundingCapsule& first = moving.at_middle;
  const double half = n.dot(first.half_axis), half_change = n.dot(moving.half_axis_velocity);
  const double approach = n.dot(moving.velocity) + std::abs(half + half_change) - std::abs(half) +
                          first.radius * n.cross(moving.angular).squaredNorm() / 2;
  const double highest = n.dot(first.centre) + std::abs(half) + first.radius;
  excess = -support(second_of(pair), -n) - highest - pair.clearance - rounding(pair);
  if (!(excess >= 0)) return false;
  return excess >= std::max(approach + moving.bounds.remainder, approach / (gain_ * time_));
}

/// Adds a pair to near_ that may come closer by `reach` and then below its clearance.
void StopProof::add_if_near(std::size_t index, const MovingCapsule& moving, double reach) {
  const BodyPair& pair = pairs_.pair(index);
  const ConvexBody &first = placed(pair.first), &second = second_of(pair);
  if (last_separations_[index].step != step_) {
    const Vector3 between = second.centre - first.centre;
    const double length = between.norm();
    const bool is_known = last_separations_[index].step > 0;
    if (is_known || length > 0) {
      const Vector3 n =
          is_known ? last_separations_[index].points.direction : Vector3(between / length);
      double excess = 0;
      const bool is_clear = is_clear_along(pair, moving, n, excess);
      if (excess > pairs_.excess(index)) pairs_.set_excess(index, excess);
      if (is_clear) return;
    }
  }
  if (near_.full() && pairs_.excess(index) >= farthest_near()->excess) {
    too_many_ = true;
    return;
  }
  const double rounded = rounding(pair);
  LastSeparation& known = last_separations_[index];
  if (known.step != step_) {
    Separation found = separate(index, distance_tolerance);
    if (found.lower - rounded < pair.clearance + resolution) found = separate(index, 0);
    known.points = found.points;
    known.excess = found.lower - rounded - pair.clearance;
    known.is_below = found.upper + rounded < pair.clearance + resolution;
    known.step = step_;
    pairs_.set_excess(index, std::max(pairs_.excess(index), known.excess));
  }
  if (known.excess >= reach) return;
  NearPair near;
  near.pair = index;
  near.rounding = rounded;
  near.excess = known.excess;
  near.is_below = known.is_below;
  near.start_points = near.last_points = known.points;
  near.least = std::numeric_limits<double>::infinity();
  too_many_ = too_many_ || near_.full();
  if (!near_.full()) {
    near_.push_back(near);
  } else if (const auto farthest = farthest_near(); near.excess < farthest->excess) {
    *farthest = near;
  }
}

BoundedList<StopProof::NearPair>::Iterator StopProof::farthest_near() {
  return std::max_element(near_.begin(), near_.end(),
                          [](const auto& a, const auto& b) { return a.excess < b.excess; });
}

/// Returns the number of parts with which the remainder of each is small.
int StopProof::part_count() const {
  double largest = 0;
  for (const NearPair& near : near_) {
    if (near.least < 0) largest = std::max(largest, near.remainder);
  }
  const double parts = std::ceil(std::sqrt(largest / fine_bound));
  return parts < max_parts ? std::max(1, static_cast<int>(parts)) : max_parts;
}

StopProof::PartBound StopProof::bound_on_part(const BodyPair& pair, const Vector3& n) const {
  const CarriedBody& first = bodies_->link_bodies[pair.first].carried;
  const std::size_t from = frame_of_second(pair);
  const double lowest = pair.is_obstacle
                            ? -support(bodies_->obstacle_bodies[pair.second].body, -n)
                            : lowest_along(motion_, bodies_->link_bodies[pair.second].carried, n);
  return {lowest - highest_at(motion_, first, from, n, 0),
          lowest - highest_at(motion_, first, from, n, 1)};
}

/// Bounds the distances of near_ from below on a part of the line, at whose start the frames are.
/// Along a direction n that is fixed to the second body, with s from 0 to 1 on the part, the
/// distance is at least (1 - s) start + s end - s^2 remainder: it is concave in s, and least at an
/// end.
bool StopProof::prove_part(int part, int parts) {
  bool proved = true;
  for (NearPair& near : near_) {
    if (near.finished) continue;
    const BodyPair& pair = pairs_.pair(near.pair);
    const ChainMotion::TubeBounds bounds =
        motion_.bounds(pairs_.motions().reach(pair.first),
                       bodies_->link_bodies[pair.first].carried.frame, frame_of_second(pair));
    PartBound along = bound_on_part(pair, near.last_points.direction);
    // The direction of the part before is another one in the frame of a second body that moves.
    if (part > 0 && std::min(along.start, along.end - bounds.remainder) < near.floor) {
      near.last_points = separate(near.pair, near.is_below ? 0 : distance_tolerance).points;
      along = bound_on_part(pair, near.last_points.direction);
    }
    if (part == 0) {
      near.floor = pair.clearance + near.rounding;
      if (near.is_below) near.floor = std::min(near.floor, along.start);
    }
    if (parts == 1) {
      near.approach = along.start - along.end;
      near.remainder = bounds.remainder;
      near.gap = along.start;
    }
    double least = along.end - bounds.remainder - near.floor;
    const double at_start = along.start - near.floor;
    const bool start_is_least = (part > 0 || at_start < 0) && at_start < least;
    if (start_is_least) least = at_start;
    if (least < near.least) {
      near.least = least;
      near.least_at = static_cast<double>(std::max(1, start_is_least ? part : part + 1)) / parts;
      near.part = part;
      near.least_points = near.last_points;
    }
    near.finished = along.start - near.floor - (parts - part) * bounds.displacement > 0;
    proved = proved && least >= 0;
  }
  return proved;
}

/// By how much less than the damper allows the distance falls, to first order, m; negative if more.
double StopProof::damper_slack(const NearPair& near) const {
  constexpr double rounding = 1e-12;
  return gain_ * time_ * (near.gap - near.floor) - near.approach + rounding;
}

bool StopProof::is_damped() const {
  return std::all_of(near_.begin(), near_.end(),
                     [this](const NearPair& near) { return damper_slack(near) >= 0; });
}

void StopProof::fill_gradient(std::size_t index, const NearestPoints& points,
                              Eigen::VectorXd& gradient) const {
  const BodyPair& pair = pairs_.pair(index);
  const Chain& chain = chain_of(bodies_->arm);
  gradient.setZero();
  const std::size_t last = bodies_->link_bodies[pair.first].carried.frame;
  for (std::size_t l = frame_of_second(pair) + 1; l <= last; ++l) {
    const Chain::Link& link = chain.links[l - 1];
    const ChainMotion::Frame& frame = motion_.frame(l);
    const Vector3 z = frame.rotation.col(2);
    const Vector3 velocity =
        link.theta_per_q * z.cross(points.on_a - frame.origin) + link.d_per_q * z;
    gradient[link.coordinate] -= points.direction.dot(velocity);
  }
}

}  // namespace beeline::internal
