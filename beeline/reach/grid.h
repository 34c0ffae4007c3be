#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>
#include <beeline/pose/se3.h>

namespace beeline {

/// Directions that cover the unit sphere evenly: rings at equal steps of the polar angle, from +z
/// to -z, each of a multiple of four directions at equal steps of the azimuth. The three axes and
/// their opposites are among them if the spacing divides 90 degrees.
class DirectionGrid {
 public:
  /// `spacing`: the angle between neighbours, rad, from 0.01 to pi/2; rounded so that the rings
  /// fit. Throws Error for another one.
  explicit DirectionGrid(double spacing);

  Eigen::Index size() const { return first_.back(); }
  double spacing() const { return spacing_; }

  /// The polar angle (from +z) and the azimuth (from +x towards +y) of direction k, rad.
  struct Angles {
    double polar = 0, azimuth = 0;
  };
  Angles angles(Eigen::Index k) const;
  Vector3 direction(Eigen::Index k) const;

  /// The fraction of the sphere that direction k represents. The fractions sum to 1.
  double fraction(Eigen::Index k) const;

  /// The direction nearest in azimuth on the ring nearest in polar angle. It is within 0.75
  /// spacings of `direction`, which need not be of unit length. Throws Error for zero.
  Eigen::Index nearest(const Vector3& direction) const;

 private:
  Eigen::Index ring_of(Eigen::Index k) const;
  Eigen::Index count(Eigen::Index ring) const { return first_[ring + 1] - first_[ring]; }

  double spacing_ = 0;
  std::vector<Eigen::Index> first_;  // of each ring, and the number of all
};

/// Equal cells along one coordinate, m, or rad for azimuths.
struct ReachAxis {
  Eigen::Index cells = 1;  ///< number of cells
  double lower = 0;        ///< lower end of the first cell
  double step = 0;         ///< edge of a cell

  double centre(Eigen::Index i) const { return lower + (static_cast<double>(i) + 0.5) * step; }
  double upper() const { return lower + static_cast<double>(cells) * step; }
  /// The cell of a value, the last one for upper(); none for a value outside.
  std::optional<Eigen::Index> cell_of(double value) const;
};

/// The orientations of the cells of a map.
enum class ReachOrientations {
  fixed,       ///< one orientation for all cells, the option `orientation`
  headings,    ///< rotations about the world's z axis, of planar arms
  directions,  ///< tool directions, each with any roll about it
  rolls,       ///< tool directions, each with several rolls
  any,         ///< any orientation, of maps by sampling
};
std::string name(ReachOrientations orientations);

/// The angle between tool directions, or headings, of a map unless its options give it, rad.
constexpr double default_direction_spacing = std::numbers::pi / 6;

/// The positions and orientations that a map covers.
struct ReachGridOptions {
  /// Edge of the cells, m; default: a twentieth of the radius of the arm's reach.
  std::optional<double> resolution = std::nullopt;
  /// Corner of the box of positions, m, in the world, (3,); default: of the box around
  /// Arm::reach(), so that the cells' centres are multiples of a given resolution. The cells begin
  /// at `lower` and cover the box. With `azimuths` corners are (radius, height, 0).
  std::optional<Vector3> lower = std::nullopt;
  std::optional<Vector3> upper = std::nullopt;  ///< the opposite corner, (3,)
  /// Angle between azimuths, rad, 0.01 to 2 pi: positions have cylindrical coordinates about the
  /// axis of the first joint, whose inverse kinematics is solved once for all azimuths.
  std::optional<double> azimuths = std::nullopt;
  /// One orientation of the tool for all cells, world_R_tool, (3, 3); default: tool directions, or
  /// headings of a planar arm.
  std::optional<Rotation> orientation = std::nullopt;
  /// Whether any orientation counts as reached; for maps by sampling.
  bool any_orientation = false;
  /// Angle between tool directions, or headings, rad, 0.01 to pi/2: see DirectionGrid. Default:
  /// 30 degrees.
  std::optional<double> directions = std::nullopt;
  /// Angle between rolls about the tool direction, rad, 0.01 to 2 pi; default: any roll counts as
  /// reached.
  std::optional<double> rolls = std::nullopt;
};

/// The cells of a map: positions on a grid and, at each of them, the same orientations. Cell
/// numbers have the layout [x][y][z][direction][roll], the roll fastest.
///
/// A cylindrical grid has the layout [radius][height][azimuth][direction][roll]; its orientations
/// are given at azimuth 0 and rotate with the position about the axis of the first joint.
class ReachGrid {
 public:
  /// Throws Error for an option outside its range; for an orientation, or any orientation, together
  /// with directions, rolls or azimuths; for azimuths of an arm whose first joint does not turn
  /// about an axis parallel to z; for a box that is empty or without bounds; for more than a
  /// million cells along an axis or 2^52 in all; and for more than 2^22 orientations at a position.
  explicit ReachGrid(const Arm& arm, const ReachGridOptions& options = {});

  /// Options that give the same grid of the same arm.
  ReachGridOptions options() const;

  /// x, y and z, or radius, height and azimuth.
  const std::array<ReachAxis, 3>& axes() const { return axes_; }
  bool cylindrical() const { return cylindrical_; }
  /// Cells along x, y and z that cover the positions: the cells of the grid, or, for a cylindrical
  /// grid, cells of the same resolution.
  std::array<ReachAxis, 3> cartesian_axes() const;
  ReachOrientations orientations() const { return orientations_; }
  /// Orientation of ReachOrientations::fixed.
  const Rotation& orientation() const { return orientation_; }
  const DirectionGrid& direction_grid() const { return directions_; }

  Eigen::Index positions() const { return axes_[0].cells * axes_[1].cells * axes_[2].cells; }
  Eigen::Index azimuths() const { return cylindrical_ ? axes_[2].cells : 1; }
  /// Number of directions or headings; 1 if fixed.
  Eigen::Index directions() const { return direction_count_; }
  Eigen::Index rolls() const { return roll_count_; }
  Eigen::Index cells() const { return positions() * directions() * rolls(); }

  /// The indices i, j and k along axes() of position p = (i n1 + j) n2 + k.
  std::array<Eigen::Index, 3> indices(Eigen::Index p) const;
  /// The point in the world, m, with these coordinates along axes().
  Vector3 point(const Vector3& coordinates) const;
  /// The centre of position p, m, in the world.
  Vector3 centre(Eigen::Index p) const;
  /// The volume of the cell of position p, m^3; of planar arms its area, m^2.
  double volume(Eigen::Index p) const;
  /// Heading d of a grid of headings, and roll r: equal parts of a revolution, rad, the first one
  /// 0.
  double heading(Eigen::Index d) const;
  double roll(Eigen::Index r) const;
  /// The orientation of direction d with roll r, at azimuth 0 of a cylindrical grid:
  /// Rz(azimuth) Ry(polar) Rz(roll(r)), whose z axis is the direction; of headings, Rz(heading(d)).
  Rotation rotation(Eigen::Index d, Eigen::Index r) const;
  /// The pose at the centre of a cell: world_T_tool.
  Pose pose(Eigen::Index cell) const;
  /// The fraction of all orientations that direction d represents.
  double fraction(Eigen::Index d) const;

  /// The position whose cell contains a point; none for a point outside.
  std::optional<Eigen::Index> position_of(const Vector3& point) const;
  /// The cell of a pose: the one at its position that is nearest in direction and roll. A fixed
  /// orientation is not compared. None for a position outside.
  std::optional<Eigen::Index> cell_of(const Pose& world_T_tool) const;

 private:
  /// The rotation about the world's z of the orientations at position p: its azimuth, or 0.
  double turn(Eigen::Index p) const;

  std::array<ReachAxis, 3> axes_;
  bool cylindrical_ = false, planar_ = false;
  Vector3 axis_ = Vector3::Zero();  // a point of the axis of a cylindrical grid, z = 0
  ReachOrientations orientations_ = ReachOrientations::directions;
  Rotation orientation_ = Rotation::Identity();
  DirectionGrid directions_;
  Eigen::Index direction_count_ = 1, roll_count_ = 1;
};

}  // namespace beeline
