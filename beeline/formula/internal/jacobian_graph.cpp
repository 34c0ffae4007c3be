#include <beeline/formula/internal/chain_graph.h>

namespace beeline::internal {

/// Returns the twist of the tool's origin, or of the world's origin for Frame::space, in the
/// world's axes.
ChainGraph::Twist ChainGraph::twist(const Motion& motion, Frame frame) {
  const GraphNumber zero = number(0);
  const GraphVector axis = motion.rate * motion.axis;
  if (!motion.rotates) return {axis, {zero, zero, zero}};
  if (frame == Frame::space) return {cross(motion.point, axis), axis};
  return {cross(axis, position_ - motion.point), axis};
}

/// Rotates from the world's axes to the axes of the frame.
ChainGraph::Twist ChainGraph::in_axes(const Twist& twist, Frame frame) {
  if (frame != Frame::tool) return twist;
  return {rotate_back(rotation_, twist.linear), rotate_back(rotation_, twist.angular)};
}

/// Returns the entries of a matrix whose columns are the sums of the twists of each coordinate.
std::vector<ComputationGraph::Id> ChainGraph::matrix(const std::vector<Twist>& twists) {
  const auto dof = static_cast<std::size_t>(arm_.dof);
  std::vector<ComputationGraph::Id> entries(6 * dof, graph_.number(0));
  for (std::size_t i = 0; i < twists.size(); ++i) {
    const auto column = static_cast<std::size_t>(motions_[i].coordinate);
    for (std::size_t row = 0; row < 6; ++row) {
      ComputationGraph::Id& entry = entries[row * dof + column];
      entry = graph_.add(entry, (row < 3 ? twists[i].linear[row] : twists[i].angular[row - 3]).id);
    }
  }
  return entries;
}

std::vector<ComputationGraph::Id> ChainGraph::jacobian(Frame frame) {
  std::vector<Twist> twists;
  for (const Motion& motion : motions_) twists.push_back(in_axes(twist(motion, frame), frame));
  return matrix(twists);
}

/// Returns the time derivatives of the twists in the world's axes. The axis and the point of motion
/// i move with the angular velocity of all motions before it. The point's velocity is the velocity
/// of the point of motion i - 1 plus their relative velocity.
std::vector<ChainGraph::Twist> ChainGraph::rates_of_twists(Frame frame) {
  const GraphNumber zero = number(0);
  GraphVector angular{zero, zero, zero}, linear{zero, zero, zero};
  std::vector<GraphVector> angular_before,
      velocities;  // velocities of points; the tool's velocity is last
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    angular_before.push_back(angular);
    velocities.push_back(linear);
    const GraphVector motion = motions_[i].rate * rate(motions_[i]) * motions_[i].axis;
    const GraphVector next = i + 1 < motions_.size() ? motions_[i + 1].point : position_;
    GraphVector& changes = motions_[i].rotates ? angular : linear;
    changes = changes + motion;
    const GraphVector offset = next - motions_[i].point;
    linear = linear + cross(angular, offset);
  }
  velocities.push_back(linear);
  std::vector<Twist> rates;
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const GraphVector axis = motions_[i].rate * motions_[i].axis;
    const GraphVector turned = cross(angular_before[i], axis);
    if (!motions_[i].rotates) {
      rates.push_back({turned, {zero, zero, zero}});
      continue;
    }
    const GraphVector still{zero, zero, zero};
    const bool space = frame == Frame::space;
    const GraphVector arm = (space ? still : position_) - motions_[i].point;
    const GraphVector relative = (space ? still : velocities.back()) - velocities[i];
    rates.push_back({cross(turned, arm) + cross(axis, relative), turned});
  }
  if (frame != Frame::tool) return rates;
  for (std::size_t i = 0; i < rates.size(); ++i) {  // R^T (dJ - w x J)
    const Twist column = twist(motions_[i], Frame::base);
    rates[i].linear = rates[i].linear - cross(angular, column.linear);
    rates[i].angular = rates[i].angular - cross(angular, column.angular);
    rates[i] = in_axes(rates[i], frame);
  }
  return rates;
}

std::vector<ComputationGraph::Id> ChainGraph::derivative(Frame frame) {
  return matrix(rates_of_twists(frame));
}

}  // namespace beeline::internal
