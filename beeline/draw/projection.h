#pragma once

#include <beeline/draw/paper.h>

namespace beeline {

/// A direction to look in; parallel projection. The rows are the world directions that point to the
/// right on paper, upwards on paper, and towards the viewer.
using View = Rotation;

View top_view();    ///< x to the right, y up
View front_view();  ///< x to the right, z up
View side_view();   ///< y to the right, z up

/// From a direction `azimuth` from x towards y and `elevation` above the ground, radians; z is up.
/// Throws Error when one is not finite.
View oblique_view(double azimuth, double elevation);

/// "x", "y" or "z" for a row of the view (0 right, 1 up) that is this axis; empty for another.
std::string axis_name(const View& view, int row);

/// World to paper.
struct Projection {
  View view = View::Identity();
  double scale = 1;              ///< points on paper per metre
  Point origin = Point::Zero();  ///< where the world's origin lies on paper
  double pen = 1;                ///< factor on all sizes that a scene gives in points

  Point operator()(const Vector3& p) const;
  Point direction(const Vector3& d) const;  ///< a world direction on paper; no longer than d
  double depth(const Vector3& p) const { return view.row(2).dot(p); }
};

/// The first of 1, 2, 5 times a power of ten that is not below `least` (> 0).
double round_step(double least);

/// Decimals that multiples of a round step need.
int decimals_of(double step);

}  // namespace beeline
