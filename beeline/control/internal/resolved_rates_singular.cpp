#include <algorithm>
#include <cmath>

#include <beeline/control/internal/resolved_rates.h>

namespace beeline::internal {
namespace {

constexpr double done = 1e-6;    // of the command may be left over
constexpr double lost = 1e-5;    // of the largest singular value: a direction that is lost below
constexpr double gone = 1e-6;    // and one along which the arm does not move at all
constexpr double exact = 1e-12;  // a motion's direction can still be told
constexpr double rest = 1e-6;    // of full speed: the arm does not move
constexpr double flat = 1e-4;    // of the largest singular value: a bend that counts as none

}  // namespace

/// How fast the command's part along the lost direction u changes by the null motion, which
/// turn_along() has looked at: from u J = 0 follows u' J = -u J', and `way_` does the rest of it.
double ResolvedRates::turn_of_lost(const Rows& u) const {
  double moved = 0;
  for (Eigen::Index k = 0; k < way_.size(); ++k) {
    moved += way_[k] * weight[k] * u.dot(scale_.cwiseProduct(columns_.col(k)));
  }
  return -moved / ahead_;
}

/// The motion of unit length that moves nothing, or only direction `which`; whether there is one.
bool ResolvedRates::fill_null_motion(Eigen::Index which) {
  const auto& size = directions_.size;
  const double largest = size.maxCoeff();
  if (size[which] > exact * largest) {
    null_ = directions_.motion.col(which) / size[which];
    return true;
  }
  double most = 0;  // of a joint's own motion, what no direction has: the joint with the most
  for (Eigen::Index joint = 0; joint < null_.size(); ++joint) {
    kept_.setZero();
    kept_[joint] = 1;
    for (int pass = 0; pass < 2; ++pass) {
      for (Eigen::Index i = 0; i < 6; ++i) {
        if (!(size[i] > exact * largest)) continue;
        const auto motion = directions_.motion.col(i);
        kept_ -= motion.dot(kept_) / (size[i] * size[i]) * motion;
      }
    }
    const double left = kept_.norm();
    if (left > most) most = left, null_ = kept_ / left;
  }
  return most > 1e-6;
}

/// The share of the command that `way_` then does in this step.
double ResolvedRates::solve_singular(const ConfigurationRef& q, const Eigen::VectorXd& before,
                                     double time_step) {
  directions_.find(rows_);
  const auto& size = directions_.size;
  const double largest = size.maxCoeff();
  way_.setZero();
  Eigen::Index which = -1;
  double most = done * command_.norm();
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double along = directions_.u.col(i).dot(command_);
    if (size[i] > lost * largest) {
      way_ += along / (size[i] * size[i]) * directions_.motion.col(i);
    } else if (std::abs(along) > most) {
      most = std::abs(along), which = i;
    }
  }
  if (which < 0) return 1;         // the command does not ask for what is lost
  if (!fill_null_motion(which)) {  // more rows than joints: not even bending
    way_.setZero();
    return 0;
  }

  const Rows u = directions_.u.col(which);
  const double along = u.dot(command_);
  rates_.velocity = weight.cwiseProduct(null_);
  const Rows turn = turn_along(q, rates_.velocity);
  const double curve = u.dot(turn);
  const double turning = turn_of_lost(u);
  const bool bends = std::abs(curve) > flat * largest * weight.maxCoeff();
  const bool opens = bends && curve * along > 0;  // the arm bends the way that is asked for

  double going = null_.dot(before.cwiseQuotient(weight));
  double side = along > 0 ? 1 : -1;
  if (size[which] <= gone * largest) {  // either will do: go on where the arm was going
    if (std::abs(going) < rest) going = bends ? 1 : -along * turning;
    side = going < 0 ? -1 : 1;
  }
  double left = Limits::none;  // of the null motion
  if (bends && !opens) {       // not beyond the singularity, where the motion would lead back
    left = size[which] / std::abs(curve);
  } else if (!bends && side * along * turning < 0) {  // until the command needs it no more
    left = std::abs(along / turning) / 2;
  }
  double fastest = 1 / null_.lpNorm<Eigen::Infinity>();
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double v = std::abs(rates_.velocity[k]);
    const double acceleration = arm_.limits(k).acceleration / 4;
    if (v > 0) fastest = std::min(fastest, fast_to_stop(left * v, acceleration, time_step) / v);
  }
  const double gained = opens ? std::abs(curve) * time_step / 2 : 0;
  const auto speed = [&](double rate) { return (size[which] + gained * rate) * rate; };
  if (speed(fastest) > std::abs(along)) {
    fastest = 2 * std::abs(along) /
              (size[which] + std::sqrt(size[which] * size[which] + 4 * gained * std::abs(along)));
  }
  double share = std::min(1.0, speed(fastest) / std::abs(along));
  if (bends && !opens &&
      (share < lost || size[which] <= gone * largest)) {  // the arm is stretched out that way
    way_.setZero();
    return 0;
  }
  if (side * going < -rest) {  // it has to turn round first
    way_.setZero();
    share = 0;
  }
  way_ = share * way_ + side * fastest * null_;
  // The null motion itself turns as it goes: its other rows stay zero.
  for (Eigen::Index i = 0; i < 6; ++i) {
    if (i == which || !(size[i] > lost * largest)) continue;
    const double part = fastest * fastest * directions_.u.col(i).dot(turn) / (size[i] * size[i]);
    rates_.bend -= part * weight.cwiseProduct(directions_.motion.col(i));
  }
  return share;
}

}  // namespace beeline::internal
