#pragma once

#include <optional>

#include <beeline/draw/figure.h>
#include <beeline/draw/internal/paper_shapes.h>

namespace beeline::internal {

/// Returns "x", "y" or "z" when this row of the view (0 right, 1 up) is that axis; empty otherwise.
std::string axis_name(const View& view, int row);

/// Maps the world to paper.
struct Projection {
  View view = View::Identity();
  double scale = 1;                        ///< points on paper per metre
  PaperPoint origin = PaperPoint::Zero();  ///< the world's origin on paper, points
  double pen = 1;                          ///< factor on the sizes that a drawing gives in points
  std::optional<PaperBox> visible = {};  ///< rectangle in which bodies are drawn; none: everywhere

  PaperPoint operator()(const Vector3& p) const;
  PaperPoint direction(const Vector3& d) const;  ///< image of a world direction; not longer than d
  double depth(const Vector3& p) const { return view.row(2).dot(p); }
};

/// Returns the smallest of 1, 2, 5 times a power of ten that is at least `minimum` (> 0).
double round_step(double minimum);

/// Returns the number of decimals that multiples of a round step need.
int decimals_of(double step);

}  // namespace beeline::internal
