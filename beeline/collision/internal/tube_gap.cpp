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

double highest_at(const ChainMotion& motion, const CarriedBody& carried, std::size_t j,
                  const Vector3& n, double s) {
  const ChainMotion::Frame& frame = motion.frame(carried.frame);
  const ChainMotion::Frame& fixed = motion.frame(j);
  const Vector3 angular = frame.angular - fixed.angular, linear = frame.linear - fixed.linear;
  const Vector3 direction = n + s * n.cross(angular);
  return s * n.dot(linear) + direction.dot(frame.origin) +
         support(carried.body, frame.rotation.transpose() * direction);
}

double highest_along(const ChainMotion& motion, const CarriedBody& carried, std::size_t j,
                     const Vector3& n, double remainder) {
  return std::max(highest_at(motion, carried, j, n, -1), highest_at(motion, carried, j, n, 1)) +
         remainder;
}

}  // namespace beeline::internal
