#include <algorithm>

#include <beeline/collision/internal/tube_gap.h>

namespace beeline::internal {

ConvexBody in_world(const ChainMotion& motion, const CarriedBody& carried) {
  if (carried.frame == 0) return carried.body;
  const ChainMotion::Frame& frame = motion.frame(carried.frame);
  return moved(frame.rotation, frame.origin, carried.body);
}

double lowest_along(const ChainMotion& motion, const CarriedBody& carried, const Vector3& n) {
  if (carried.frame == 0) return -support(carried.body, -n);
  const ChainMotion::Frame& frame = motion.frame(carried.frame);
  return n.dot(frame.origin) - support(carried.body, -(frame.rotation.transpose() * n));
}

double highest_along(const ChainMotion& motion, const CarriedBody& carried, std::size_t j,
                     const Vector3& n, double remainder) {
  const ChainMotion::Frame& frame = motion.frame(carried.frame);
  const ChainMotion::Frame& fixed = motion.frame(j);
  const Vector3 angular = frame.angular - fixed.angular, linear = frame.linear - fixed.linear;
  const Vector3 tilt = n.cross(angular);
  const double along = n.dot(linear);
  const auto at_end = [&](double s) {
    const Vector3 direction = n + s * tilt;
    return s * along + direction.dot(frame.origin) +
           support(carried.body, frame.rotation.transpose() * direction);
  };
  return std::max(at_end(-1), at_end(1)) + remainder;
}

}  // namespace beeline::internal
