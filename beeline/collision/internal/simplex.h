#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>

#include <beeline/pose/so3.h>

namespace beeline::internal {

/// A point a - b of the Minkowski difference of two cores.
struct DifferencePoint {
  Vector3 difference, on_a, on_b;
};

/// One to four points with the weights of the point of their hull that is nearest to the origin.
class Simplex {
 public:
  int size() const { return size_; }

  void add(const DifferencePoint& point) { points_[static_cast<std::size_t>(size_++)] = point; }

  bool has(const Vector3& difference) const {
    return std::any_of(points_.begin(), points_.begin() + size_,
                       [&](const auto& point) { return point.difference == difference; });
  }

  /// Drops the points without weight.
  void reduce();

  /// Returns its nearest point as a simplex of one point.
  Simplex collapsed() const {
    Simplex point;
    point.add({nearest(), on_a(), on_b()});
    point.weights_[0] = 1;
    return point;
  }

  Vector3 nearest() const { return sum(&DifferencePoint::difference); }

  /// Returns the unit vector from the nearest point to the origin, which is not in the simplex. It
  /// is at right angles to the edges. Of a nearest point close to the origin few digits remain, but
  /// the edges have theirs.
  Vector3 towards_origin() const;

  Vector3 on_a() const { return sum(&DifferencePoint::on_a); }
  Vector3 on_b() const { return sum(&DifferencePoint::on_b); }
  const Vector3& of_a(int i) const { return points_[static_cast<std::size_t>(i)].on_a; }
  const Vector3& of_b(int i) const { return points_[static_cast<std::size_t>(i)].on_b; }

 private:
  const Vector3& at(int i) const { return points_[static_cast<std::size_t>(i)].difference; }

  Vector3 sum(Vector3 DifferencePoint::*member) const {
    Vector3 total = Vector3::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(size_); ++i) {
      total += weights_[i] * points_[i].*member;
    }
    return total;
  }

  void keep(std::initializer_list<int> indices, std::initializer_list<double> weights);
  void reduce_segment();
  /// The regions of Ericson, "Real-Time Collision Detection" (2005), section 5.1.5.
  void reduce_triangle();

  /// The nearest of the four faces, unless the origin is inside.
  void reduce_tetrahedron();

  /// The weights of the origin, which is inside the tetrahedron.
  void set_weights_of_origin();

  /// Changes the weights of three or four points by Newton's step for the least |nearest()| in
  /// their plane or space: the proportions above lose digits where the points are far from the
  /// origin and some of them are close to each other.
  void refine();

  /// Returns the changes of the weights of all points but the first that move `point` to the origin
  /// or, of three points, to the point of their plane that is nearest to it.
  Vector3 change_in_plane(const Vector3& point) const;
  Vector3 change_in_space(const Vector3& point) const;

  /// Sets weights in these proportions. Weighted means are points of the bodies only if no weight
  /// is negative and their sum is 1, also where rounding gives other proportions.
  void set_weights(const std::array<double, 4>& proportions);

  void collapse_to_first() { keep({0}, {1}); }

  std::array<DifferencePoint, 4> points_;
  std::array<double, 4> weights_{};
  int size_ = 0;
};

}  // namespace beeline::internal
