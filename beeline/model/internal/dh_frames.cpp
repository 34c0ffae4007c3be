#include <cmath>

#include <beeline/model/internal/dh_frames.h>
#include <beeline/model/internal/joint_axes.h>

namespace beeline::internal {
namespace {

/// Angles and, for arms of up to a metre, distances below this are rounding.
constexpr double dh_rounding = 1e-13;

Vector3 nearest_on(const DhAxis& axis, const Vector3& point) {
  return axis.point + axis.direction.dot(point - axis.point) * axis.direction;
}

/// The unit vector normal to the axis that is nearest to the x axis of a frame.
Vector3 x_near(const DhAxis& axis, const Pose& frame) {
  for (const int column : {0, 1}) {
    const Vector3 x = frame.linear().col(column);
    const Vector3 normal = x - x.dot(axis.direction) * axis.direction;
    if (normal.norm() > 0.1) return normal.normalized();
  }
  return axis.direction.unitOrthogonal();  // not reached: x and y are not both along the axis
}

/// The frame on an axis, with z along it, that is nearest to another frame.
Pose frame_near(const DhAxis& axis, const Pose& frame) {
  return frame_along(x_near(axis, frame), axis.direction, nearest_on(axis, frame.translation()));
}

/// Whether a frame has its x axis normal to the axis, through a point of it.
bool meets_with_x(const Pose& frame, const DhAxis& axis, double unit) {
  const Vector3 x = frame.linear().col(0);
  const double distance = (frame.translation() - axis.point).dot(axis.direction.cross(x));
  return std::abs(x.dot(axis.direction)) < dh_rounding && std::abs(distance) < dh_rounding * unit;
}

/// Whether a frame has its origin on the axis, and z along it.
bool lies_on(const Pose& frame, const DhAxis& axis, double unit) {
  return (frame.linear().col(2) - axis.direction).norm() < dh_rounding &&
         (frame.translation() - nearest_on(axis, frame.translation())).norm() < dh_rounding * unit;
}

/// The frames of one arm.
class FramesOfArm {
 public:
  FramesOfArm(const Arm& arm, DhConvention convention)
      : arm_(arm), standard_(convention == DhConvention::standard) {
    links_.push_back(Pose::Identity());
    for (const Joint& joint : arm.joints()) links_.push_back(links_.back() * joint.offset);
    for (const Pose& link : links_) {
      unit_ = std::max(unit_, link.translation().norm());
    }
    for (std::size_t i = 0; i < arm.joints().size(); ++i) add_axis(i);
  }

  DhFrames frames() {
    const std::size_t n = found_.axes.size();
    found_.frames.push_back(first());
    for (std::size_t i = 1; i < n; ++i) add_between(i);
    found_.frames.push_back(last());
    return std::move(found_);
  }

 private:
  void add_axis(std::size_t i) {
    const Twist screw = adjoint(links_[i + 1], arm_.joints()[i].screw);
    const Vector3 v = screw.head<3>(), w = screw.tail<3>();
    if (w.isZero(0)) {
      found_.axes.push_back({v, links_[standard_ ? i : i + 1].translation(), true});
    } else {
      // From the screw in the link, whose moment is not rounded by the link's distance.
      const Twist& own = arm_.joints()[i].screw;
      found_.axes.push_back({w, links_[i + 1] * Vector3(own.tail<3>().cross(own.head<3>()))});
    }
  }

  Pose first() const {
    const DhAxis& axis = found_.axes.front();
    const bool fits = !standard_ && meets_with_x(links_.front(), axis, unit_);
    return fits ? links_.front() : frame_near(axis, links_.front());
  }

  Pose last() const {
    const DhAxis& axis = found_.axes.back();
    const Pose tool = links_.back() * arm_.tool();
    for (const Pose& frame : {links_.back(), tool}) {
      if (standard_ ? meets_with_x(frame, axis, unit_) : lies_on(frame, axis, unit_)) return frame;
    }
    return frame_near(axis, links_.back());
  }

  /// Adds frame i, of the link between axes i - 1 and i.
  void add_between(std::size_t i) {
    const DhAxis& before = found_.axes[i - 1];
    const DhAxis& behind = found_.axes[i];
    const DhAxis& own = standard_ ? behind : before;
    const Pose& link = links_[i];
    const Vector3 cross = before.direction.cross(behind.direction);
    const Vector3 between = behind.point - before.point;
    Vector3 origin = nearest_on(own, link.translation());
    Vector3 x;
    DhNormal normal = DhNormal::unique;
    if (cross.norm() > dh_rounding) {
      const Vector3& other = standard_ ? before.direction : behind.direction;
      origin = own.point + between.cross(other).dot(cross) / cross.squaredNorm() * own.direction;
      x = cross.normalized();
    } else {
      const Vector3 normal_to = between - between.dot(before.direction) * before.direction;
      normal = normal_to.norm() > dh_rounding * unit_ ? DhNormal::parallel : DhNormal::coincident;
      x = normal == DhNormal::parallel ? normal_to.normalized() : x_near(own, link);
    }
    found_.frames.push_back(frame_along(signed_x(exactly_normal(x, own.direction), between, link),
                                        own.direction, origin));
    found_.normals.push_back(normal);
    found_.distances.push_back((origin - link.translation()).norm());
  }

  static Vector3 exactly_normal(const Vector3& x, const Vector3& z) {
    return (x - x.dot(z) * z).normalized();
  }

  /// x or -x: the x axis of the link's frame or, if it has neither, the one with a length a that is
  /// not negative.
  Vector3 signed_x(const Vector3& x, const Vector3& between, const Pose& link) const {
    constexpr double same = 1e-9;
    const Vector3 own = link.linear().col(0);
    if ((x - own).norm() < same) return x;
    if ((x + own).norm() < same) return -x;
    return between.dot(x) < -dh_rounding * unit_ ? Vector3(-x) : x;
  }

  const Arm& arm_;
  bool standard_;
  std::vector<Pose> links_;  ///< of links 0 to n in link 0
  double unit_ = 1;          ///< size of the arm, at least 1 m
  DhFrames found_ = {};
};

}  // namespace

DhFrames dh_frames(const Arm& arm, DhConvention convention) {
  return FramesOfArm(arm, convention).frames();
}

}  // namespace beeline::internal
