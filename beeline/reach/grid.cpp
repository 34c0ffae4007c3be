#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <beeline/reach/grid.h>
#include <beeline/reach/internal/orientation_names.h>
#include <beeline/reach/internal/turning_joint.h>

namespace beeline {

using std::numbers::pi;

namespace {

/// Throws Error unless `lower` is below `upper` along each axis, both finite.
void check_box(const Arm& arm, const Vector3& lower, const Vector3& upper,
               const std::array<const char*, 3>& axes) {
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(lower[k]) || !std::isfinite(upper[k])) {
      throw Error("the reach of " + arm.name() + " has no bounds: give the box of the map");
    }
    if (lower[k] > upper[k]) {
      throw Error::of("lower", std::string("the box of the map is empty: its lower ") + axes[k] +
                                   " is " + number(lower[k]) + ", its upper one " +
                                   number(upper[k]));
    }
  }
}

ReachAxis axis_over(double lower, double upper, double step) {
  // A length that is a whole number of cells to rounding has that number of cells.
  constexpr double rounding = 1e-9;
  constexpr double most = 1e6;
  const double farthest = std::max(std::abs(lower), std::abs(upper));
  if (!(step > 1e-9 * farthest)) {
    throw Error("cells of " + number(step) + " m cannot be told apart " + number(farthest) +
                " m from the origin: a coarser resolution or a nearer box can");
  }
  const double cells = std::max(1.0, std::ceil((upper - lower) / step - rounding));
  if (!(cells <= most)) {
    throw Error("the map would have " + number(cells) +
                " cells along an axis; at most a million are possible: a coarser resolution or a "
                "smaller box has fewer");
  }
  return {static_cast<Eigen::Index>(cells), lower, step};
}

/// The edge of the cells, m.
double resolution_of(const Arm& arm, const ReachGridOptions& options) {
  const double resolution = options.resolution.value_or(arm.reach().radius / 20);
  if (options.resolution && !(resolution >= 1e-9 && resolution <= 1e6)) {
    throw Error("the resolution is " + number(resolution) + " m; it can be 1e-9 to 1e6");
  }
  if (!(resolution > 0)) throw Error("arm " + arm.name() + " has no reach: give the resolution");
  return resolution;
}

std::array<ReachAxis, 3> box_axes(const Arm& arm, const ReachGridOptions& options) {
  const Arm::Reach& reach = arm.reach();
  const double resolution = resolution_of(arm, options);
  const Vector3 half = Vector3::Constant(reach.radius);
  Vector3 lowest = reach.centre - half;
  if (options.resolution) {  // the centres are its multiples, round numbers
    lowest = (((lowest / resolution).array() - 0.5).floor() + 0.5) * resolution;
  }
  const Vector3 lower = options.lower.value_or(lowest);
  const Vector3 upper = options.upper.value_or(reach.centre + half);
  check_box(arm, lower, upper, {"x", "y", "z"});
  std::array<ReachAxis, 3> axes;
  for (int k = 0; k < 3; ++k) axes[k] = axis_over(lower[k], upper[k], resolution);
  if (arm.planar()) axes[2] = {1, reach.centre.z() - resolution / 2, resolution};
  return axes;
}

/// The number of equal angles of about `spacing`, the option `argument`, in a revolution.
Eigen::Index angles_around(double spacing, const char* what, const char* argument) {
  if (!(spacing >= 0.01 && spacing <= 2 * pi + 1e-9)) {
    throw Error::of(argument, std::string("the angle between ") + what + " is " + number(spacing) +
                                  " rad; it can be 0.01 to 6.2832 (0.6 to 360 degrees)");
  }
  return static_cast<Eigen::Index>(std::round(2 * pi / spacing));
}

/// A point of the axis of the first joint, about which the arm turns.
Vector3 axis_of(const Arm& arm) {
  const std::optional<internal::TurningJoint> base = internal::base_joint(arm);
  if (base) return base->axis_point;
  const double tilt = internal::base_tilt(arm);
  const bool nearly = tilt > 1e-12 && tilt < 0.01;  // the angles of a file have few digits
  throw Error::of(
      "azimuths",
      "the first joint of " + arm.name() +
          " does not turn it about an axis parallel to the world's z, which a map by azimuths "
          "needs" +
          (nearly ? ": its axis is tilted by " + number(tilt) +
                        " rad; in a URDF file, write a right angle as 1.5707963267948966"
                  : ""));
}

/// Radius, height and azimuth about an axis.
std::array<ReachAxis, 3> cylinder_axes(const Arm& arm, const Vector3& axis,
                                       const ReachGridOptions& options) {
  const Arm::Reach& reach = arm.reach();
  const double step = resolution_of(arm, options);
  const double far = reach.radius + (reach.centre - axis).head<2>().norm();
  double lowest = reach.centre.z() - reach.radius;
  if (options.resolution) lowest = (std::floor(lowest / step - 0.5) + 0.5) * step;
  const Vector3 lower = options.lower.value_or(Vector3(0, lowest, 0));
  const Vector3 upper = options.upper.value_or(Vector3(far, reach.centre.z() + reach.radius, 0));
  check_box(arm, lower, upper, {"radius", "height", "azimuth"});
  if (lower[2] != 0 || upper[2] != 0) {
    throw Error::of("azimuths",
                    "a corner of a map by azimuths is (radius, height, 0): its third number is " +
                        number(lower[2] != 0 ? lower[2] : upper[2]));
  }
  if (lower[0] < 0) {
    throw Error::of("azimuths",
                    "the least radius of the map is " + number(lower[0]) + " m; it is 0 or more");
  }
  const auto around = angles_around(*options.azimuths, "azimuths", "azimuths");
  const double angle = 2 * pi / static_cast<double>(around);
  std::array<ReachAxis, 3> axes{axis_over(lower[0], upper[0], step),
                                axis_over(lower[1], upper[1], step),
                                ReachAxis{around, -angle / 2, angle}};
  if (arm.planar()) axes[1] = {1, reach.centre.z() - step / 2, step};
  return axes;
}

Rotation about_z(double angle) {
  return Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
}

}  // namespace

std::string name(ReachOrientations orientations) {
  return internal::orientation_names.of(orientations);
}

std::optional<Eigen::Index> ReachAxis::cell_of(double value) const {
  const double rounding = 1e-9 * step;  // a point on an edge is inside, despite rounding
  if (!(value >= lower - rounding && value <= upper() + rounding)) return std::nullopt;
  const double steps = std::max(0.0, (value - lower) / step);
  return std::min(static_cast<Eigen::Index>(steps), cells - 1);
}

ReachGrid::ReachGrid(const Arm& arm, const ReachGridOptions& options)
    : cylindrical_(options.azimuths), planar_(arm.planar()), directions_(pi / 2) {
  const bool alone = options.orientation || options.any_orientation;
  if ((alone && (options.directions || options.rolls)) ||
      (options.orientation && options.any_orientation)) {
    throw Error::of(
        "any_orientation",
        "a map has one orientation, any orientation, or directions and rolls: not several");
  }
  if (alone && cylindrical_) {
    throw Error::of(
        "azimuths",
        "the orientations of a map by azimuths turn with the azimuth: give directions, not "
        "one orientation or any");
  }
  if (cylindrical_) axis_ = axis_of(arm);
  axes_ = cylindrical_ ? cylinder_axes(arm, axis_, options) : box_axes(arm, options);
  if (options.any_orientation) {
    orientations_ = ReachOrientations::any;
  } else if (options.orientation) {
    orientations_ = ReachOrientations::fixed;
    Pose pose = Pose::Identity();
    pose.linear() = *options.orientation;
    try {
      orientation_ = checked_pose(pose, "the orientation of the map").linear();
    } catch (const Error& error) {
      throw Error::of("orientation", error.what());
    }
  } else if (arm.planar()) {
    if (options.rolls) throw Error("a planar arm has headings, no rolls");
    orientations_ = ReachOrientations::headings;
    direction_count_ = angles_around(options.directions.value_or(default_direction_spacing),
                                     "headings", "directions");
  } else {
    directions_ = DirectionGrid(options.directions.value_or(default_direction_spacing));
    direction_count_ = directions_.size();
    if (options.rolls) {
      orientations_ = ReachOrientations::rolls;
      roll_count_ = angles_around(*options.rolls, "rolls", "rolls");
    }
  }
  constexpr Eigen::Index most_at_position = Eigen::Index{1} << 22;
  if (direction_count_ * roll_count_ > most_at_position) {
    throw Error("each position would have " +
                number(static_cast<double>(direction_count_ * roll_count_)) +
                " orientations, at most 4194304 are possible: larger angles have fewer");
  }
  double cells = static_cast<double>(direction_count_ * roll_count_);
  for (const ReachAxis& axis : axes_) cells *= static_cast<double>(axis.cells);
  constexpr double most = 4503599627370496;  // 2^52: cell numbers are exact as double, too
  if (!(cells <= most)) {
    throw Error("the map would have " + number(cells) +
                " cells; at most 4.5e15 are possible: a coarser resolution has fewer");
  }
}

ReachGridOptions ReachGrid::options() const {
  ReachGridOptions options{
      .resolution = axes_[0].step, .lower = Vector3::Zero(), .upper = Vector3::Zero()};
  for (int k = 0; k < 3; ++k) {
    (*options.lower)[k] = axes_[k].lower;
    (*options.upper)[k] = axes_[k].upper();
  }
  if (cylindrical_) {
    options.azimuths = axes_[2].step;
    (*options.lower)[2] = (*options.upper)[2] = 0;
  }
  switch (orientations_) {
    case ReachOrientations::fixed:
      options.orientation = orientation_;
      break;
    case ReachOrientations::any:
      options.any_orientation = true;
      break;
    case ReachOrientations::headings:
      options.directions = 2 * pi / static_cast<double>(direction_count_);
      break;
    case ReachOrientations::rolls:
      options.rolls = 2 * pi / static_cast<double>(roll_count_);
      [[fallthrough]];
    case ReachOrientations::directions:
      options.directions = directions_.spacing();
  }
  return options;
}

std::array<Eigen::Index, 3> ReachGrid::indices(Eigen::Index p) const {
  const Eigen::Index nz = axes_[2].cells, ny = axes_[1].cells;
  return {p / (ny * nz), p / nz % ny, p % nz};
}

std::array<ReachAxis, 3> ReachGrid::cartesian_axes() const {
  if (!cylindrical_) return axes_;
  const double step = axes_[0].step;
  const double cells = std::ceil(axes_[0].upper() / step - 1e-9);
  const auto across = static_cast<Eigen::Index>(2 * cells);
  return {ReachAxis{across, axis_.x() - cells * step, step},
          ReachAxis{across, axis_.y() - cells * step, step}, axes_[1]};
}

Vector3 ReachGrid::point(const Vector3& coordinates) const {
  if (!cylindrical_) return coordinates;
  const double radius = coordinates[0], azimuth = coordinates[2];
  return axis_ + Vector3(radius * std::cos(azimuth), radius * std::sin(azimuth), coordinates[1]);
}

Vector3 ReachGrid::centre(Eigen::Index p) const {
  const auto [i, j, k] = indices(p);
  return point({axes_[0].centre(i), axes_[1].centre(j), axes_[2].centre(k)});
}

double ReachGrid::volume(Eigen::Index p) const {
  const double edge = axes_[0].step;
  const double height = planar_ ? 1 : edge;
  if (!cylindrical_) return edge * edge * height;
  return axes_[0].centre(indices(p)[0]) * edge * axes_[2].step * height;
}

double ReachGrid::turn(Eigen::Index p) const {
  return cylindrical_ ? axes_[2].centre(indices(p)[2]) : 0;
}

double ReachGrid::heading(Eigen::Index d) const {
  return 2 * pi * static_cast<double>(d) / static_cast<double>(direction_count_);
}

double ReachGrid::roll(Eigen::Index r) const {
  return 2 * pi * static_cast<double>(r) / static_cast<double>(roll_count_);
}

Rotation ReachGrid::rotation(Eigen::Index d, Eigen::Index r) const {
  const bool one = directions() == 1 && rolls() == 1;  // fixed, or any
  if (one) return orientation_;
  if (orientations_ == ReachOrientations::headings) return about_z(heading(d));
  const DirectionGrid::Angles at = directions_.angles(d);
  return about_z(at.azimuth) * Eigen::AngleAxisd(at.polar, Vector3::UnitY()).toRotationMatrix() *
         about_z(roll(r));
}

Pose ReachGrid::pose(Eigen::Index cell) const {
  const Eigen::Index r = cell % rolls(), d = cell / rolls() % directions();
  const Eigen::Index p = cell / (rolls() * directions());
  Pose pose = Pose::Identity();
  pose.linear() = cylindrical_ ? about_z(turn(p)) * rotation(d, r) : rotation(d, r);
  pose.translation() = centre(p);
  return pose;
}

double ReachGrid::fraction(Eigen::Index d) const {
  const bool sphere =
      orientations_ == ReachOrientations::directions || orientations_ == ReachOrientations::rolls;
  return sphere ? directions_.fraction(d) : 1 / static_cast<double>(direction_count_);
}

std::optional<Eigen::Index> ReachGrid::position_of(const Vector3& point) const {
  Vector3 coordinates = point;
  if (cylindrical_) {
    const Vector3 from_axis = point - axis_;
    double azimuth = std::atan2(from_axis.y(), from_axis.x());
    if (azimuth < axes_[2].lower) azimuth = std::min(azimuth + 2 * pi, axes_[2].upper());
    coordinates = {from_axis.head<2>().norm(), from_axis.z(), azimuth};
  }
  Eigen::Index p = 0;
  for (int k = 0; k < 3; ++k) {
    const std::optional<Eigen::Index> i = axes_[k].cell_of(coordinates[k]);
    if (!i) return std::nullopt;
    p = p * axes_[k].cells + *i;
  }
  return p;
}

std::optional<Eigen::Index> ReachGrid::cell_of(const Pose& world_T_tool) const {
  const std::optional<Eigen::Index> p = position_of(world_T_tool.translation());
  if (!p) return std::nullopt;
  Rotation world_R_tool = world_T_tool.linear();
  if (cylindrical_) world_R_tool = about_z(-turn(*p)) * world_R_tool;
  const auto nearest_of = [](const Rotation& rotation, Eigen::Index count) {
    const double revolution = std::atan2(rotation(1, 0), rotation(0, 0)) / (2 * pi);
    const auto step =
        static_cast<Eigen::Index>(std::round(revolution * static_cast<double>(count)));
    return (step + count) % count;
  };
  Eigen::Index d = 0, r = 0;
  if (orientations_ == ReachOrientations::headings) d = nearest_of(world_R_tool, directions());
  if (orientations_ == ReachOrientations::directions || orientations_ == ReachOrientations::rolls) {
    d = directions_.nearest(world_R_tool.col(2));
    if (rolls() > 1) r = nearest_of(rotation(d, 0).transpose() * world_R_tool, rolls());
  }
  return (*p * directions() + d) * rolls() + r;
}

}  // namespace beeline
