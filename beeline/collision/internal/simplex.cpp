#include <cmath>
#include <limits>
#include <utility>

#include <beeline/collision/internal/simplex.h>
#include <beeline/math/decompositions.h>

namespace beeline::internal {

void Simplex::reduce() {
  switch (size_) {
    case 1:
      weights_[0] = 1;
      break;
    case 2:
      reduce_segment();
      break;
    case 3:
      reduce_triangle();
      break;
    default:
      reduce_tetrahedron();
  }
}

Vector3 Simplex::towards_origin() const {
  Vector3 direction = -nearest();
  if (size_ == 2) {
    const Vector3 along = (at(1) - at(0)).normalized();
    for (int i = 0; i < 2; ++i) direction -= direction.dot(along) * along;
  } else if (size_ == 3) {
    const Vector3 ab = at(1) - at(0), ac = at(2) - at(0);
    const Vector3 normal = ab.cross(ac);
    if (normal.norm() > 1e-10 * ab.norm() * ac.norm()) {
      direction = at(0).dot(normal) > 0 ? Vector3(-normal) : normal;
    }
  }
  const double length = direction.norm();
  return length > 0 ? Vector3(direction / length) : Vector3(-nearest().normalized());
}

void Simplex::keep(std::initializer_list<int> indices, std::initializer_list<double> weights) {
  std::array<DifferencePoint, 4> kept;
  std::size_t n = 0;
  for (const int i : indices) kept[n++] = points_[static_cast<std::size_t>(i)];
  std::copy_n(kept.begin(), n, points_.begin());
  std::copy(weights.begin(), weights.end(), weights_.begin());
  size_ = static_cast<int>(n);
}

void Simplex::reduce_segment() {
  const Vector3 along = at(1) - at(0);
  const double length = along.squaredNorm();
  const double t = length > 0 ? -at(0).dot(along) / length : 0;
  if (t <= 0) return keep({0}, {1});
  if (t >= 1) return keep({1}, {1});
  weights_ = {1 - t, t};
}

void Simplex::reduce_triangle() {
  const Vector3 ab = at(1) - at(0), ac = at(2) - at(0);
  const double d1 = -ab.dot(at(0)), d2 = -ac.dot(at(0));
  if (d1 <= 0 && d2 <= 0) return keep({0}, {1});
  const double d3 = -ab.dot(at(1)), d4 = -ac.dot(at(1));
  if (d3 >= 0 && d4 <= d3) return keep({1}, {1});
  const double d5 = -ab.dot(at(2)), d6 = -ac.dot(at(2));
  if (d6 >= 0 && d5 <= d6) return keep({2}, {1});
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = d1 / (d1 - d3);
    return keep({0, 1}, {1 - t, t});
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = d2 / (d2 - d6);
    return keep({0, 2}, {1 - t, t});
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return keep({1, 2}, {1 - t, t});
  }
  set_weights({va, vb, vc});
  refine();
}

void Simplex::reduce_tetrahedron() {
  constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  Simplex best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& face : faces) {
    const Vector3 normal = (at(face[1]) - at(face[0])).cross(at(face[2]) - at(face[0]));
    const double inner = normal.dot(at(face[3]) - at(face[0]));
    const double origin = -normal.dot(at(face[0]));
    // A flat tetrahedron does not show the side of the face where the origin is.
    const double rounding = 1e-12 * normal.norm() * at(face[0]).norm();
    if ((inner > rounding && origin > rounding) || (inner < -rounding && origin < -rounding)) {
      continue;
    }
    Simplex part;
    for (int i = 0; i < 3; ++i) part.add(points_[static_cast<std::size_t>(face[i])]);
    part.reduce();
    const double size = part.nearest().squaredNorm();
    if (size < least) least = size, best = part;
  }
  if (best.size_ > 0) {
    *this = best;
  } else {
    set_weights_of_origin();
  }
}

void Simplex::set_weights_of_origin() {
  const auto volume = [&](const Vector3& p, const Vector3& q, const Vector3& r) {
    return std::abs(p.cross(q).dot(r));
  };
  set_weights({volume(at(1), at(2), at(3)), volume(at(0), at(2), at(3)),
               volume(at(0), at(1), at(3)), volume(at(0), at(1), at(2))});
  refine();
}

void Simplex::refine() {
  constexpr double enough = 1e-15;
  for (int step = 0; step < 2 && size_ >= 3; ++step) {
    const Vector3 point = nearest();
    double along = 0;  // 0 at the nearest point
    for (int i = 1; i < size_; ++i) {
      const Vector3 edge = at(i) - at(0);
      along = std::max(along, std::abs(point.dot(edge)) / edge.norm());
    }
    if (!(along > enough * at(0).norm())) return;
    const Vector3 change = size_ == 3 ? change_in_plane(point) : change_in_space(point);
    if (!change.allFinite()) return;
    std::array<double, 4> refined = weights_;
    for (int i = 1; i < size_; ++i) {
      refined[static_cast<std::size_t>(i)] += change[i - 1];
      refined[0] -= change[i - 1];
    }
    const std::array<double, 4> before = weights_;
    set_weights(refined);
    if (nearest().squaredNorm() < point.squaredNorm()) continue;
    weights_ = before;
    return;
  }
}

Vector3 Simplex::change_in_plane(const Vector3& point) const {
  int first = 1, second = 2;
  if ((at(1) - at(0)).squaredNorm() < (at(2) - at(0)).squaredNorm()) std::swap(first, second);
  const Vector3 u = at(first) - at(0), edge = at(second) - at(0);
  const double size = u.squaredNorm();
  double along = u.dot(edge) / size;
  Vector3 w = edge - along * u;  // at right angles to u, to rounding
  const double rest = u.dot(w) / size;
  w -= rest * u;
  along += rest;
  const double height = w.squaredNorm();
  Vector3 change = Vector3::Zero();
  if (height > 1e-30 * edge.squaredNorm()) change[second - 1] = -w.dot(point) / height;
  change[first - 1] = -u.dot(point) / size - along * change[second - 1];
  return change;
}

Vector3 Simplex::change_in_space(const Vector3& point) const {
  Eigen::Matrix3d edges;
  for (int i = 1; i < 4; ++i) edges.col(i - 1) = at(i) - at(0);
  return edges.colPivHouseholderQr().solve(-point);
}

void Simplex::set_weights(const std::array<double, 4>& proportions) {
  double total = 0;
  for (const double proportion : proportions) total += std::max(proportion, 0.0);
  if (!(total > 0)) return collapse_to_first();
  for (std::size_t i = 0; i < 4; ++i) weights_[i] = std::max(proportions[i], 0.0) / total;
}

}  // namespace beeline::internal
