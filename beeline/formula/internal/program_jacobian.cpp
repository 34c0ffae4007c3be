#include <beeline/formula/internal/program_chain.h>

namespace beeline::internal {

/// The twist of the tool's origin, or of the world's for Frame::space, in the world's axes.
ProgramChain::Twist ProgramChain::twist(const Motion& motion, Frame frame) {
  const Program::Id zero = program_.number(0);
  const ProgramVector axis = scale(program_, motion.rate, motion.axis);
  if (!motion.rotates) return {axis, {zero, zero, zero}};
  if (frame == Frame::space) return {cross(program_, motion.point, axis), axis};
  return {cross(program_, axis, subtract(program_, position_, motion.point)), axis};
}

/// From the world's axes to those of the frame.
ProgramChain::Twist ProgramChain::in_axes(const Twist& twist, Frame frame) {
  if (frame != Frame::tool) return twist;
  return {rotate_back(program_, rotation_, twist.linear),
          rotate_back(program_, rotation_, twist.angular)};
}

/// The entries of a matrix whose columns are the sums of the twists of each coordinate.
std::vector<Program::Id> ProgramChain::matrix(const std::vector<Twist>& twists) {
  const auto dof = static_cast<std::size_t>(arm_.dof);
  std::vector<Program::Id> entries(6 * dof, program_.number(0));
  for (std::size_t i = 0; i < twists.size(); ++i) {
    const auto column = static_cast<std::size_t>(motions_[i].coordinate);
    for (std::size_t row = 0; row < 6; ++row) {
      Program::Id& entry = entries[row * dof + column];
      entry = program_.add(entry, row < 3 ? twists[i].linear[row] : twists[i].angular[row - 3]);
    }
  }
  return entries;
}

std::vector<Program::Id> ProgramChain::jacobian(Frame frame) {
  std::vector<Twist> twists;
  for (const Motion& motion : motions_) twists.push_back(in_axes(twist(motion, frame), frame));
  return matrix(twists);
}

Program::Id ProgramChain::rate(const Motion& motion) {
  return program_.variable("dq[" + std::to_string(motion.coordinate) + ']');
}

/// The time derivatives of the twists in the world's axes. The axis and the point of motion i move
/// with the angular velocity of all motions before it; the point's velocity is that of the point of
/// motion i - 1, plus the velocity of the one relative to the other.
std::vector<ProgramChain::Twist> ProgramChain::rates_of_twists(Frame frame) {
  const Program::Id zero = program_.number(0);
  ProgramVector angular{zero, zero, zero}, linear{zero, zero, zero};
  std::vector<ProgramVector> angular_before, velocities;  // velocities of points, the tool last
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    angular_before.push_back(angular);
    velocities.push_back(linear);
    const ProgramVector motion =
        scale(program_, program_.multiply(motions_[i].rate, rate(motions_[i])), motions_[i].axis);
    const ProgramVector next = i + 1 < motions_.size() ? motions_[i + 1].point : position_;
    ProgramVector& changes = motions_[i].rotates ? angular : linear;
    changes = add(program_, changes, motion);
    const ProgramVector offset = subtract(program_, next, motions_[i].point);
    linear = add(program_, linear, cross(program_, angular, offset));
  }
  velocities.push_back(linear);
  std::vector<Twist> rates;
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const ProgramVector axis = scale(program_, motions_[i].rate, motions_[i].axis);
    const ProgramVector turned = cross(program_, angular_before[i], axis);
    if (!motions_[i].rotates) {
      rates.push_back({turned, {zero, zero, zero}});
      continue;
    }
    const bool space = frame == Frame::space;
    const ProgramVector arm = space ? subtract(program_, {zero, zero, zero}, motions_[i].point)
                                    : subtract(program_, position_, motions_[i].point);
    const ProgramVector relative = space ? subtract(program_, {zero, zero, zero}, velocities[i])
                                         : subtract(program_, velocities.back(), velocities[i]);
    rates.push_back(
        {add(program_, cross(program_, turned, arm), cross(program_, axis, relative)), turned});
  }
  if (frame != Frame::tool) return rates;
  for (std::size_t i = 0; i < rates.size(); ++i) {  // R^T (dJ - w x J)
    const Twist column = twist(motions_[i], Frame::base);
    rates[i].linear = subtract(program_, rates[i].linear, cross(program_, angular, column.linear));
    rates[i].angular =
        subtract(program_, rates[i].angular, cross(program_, angular, column.angular));
    rates[i] = in_axes(rates[i], frame);
  }
  return rates;
}

std::vector<Program::Id> ProgramChain::derivative(Frame frame) {
  return matrix(rates_of_twists(frame));
}

}  // namespace beeline::internal
