#pragma once

#include <vector>

#include <beeline/draw/paper.h>

namespace beeline::internal {

PaperPath open_path(const std::vector<PaperPoint>& points);
PaperPath closed_path(const std::vector<PaperPoint>& points);

/// Returns the ellipse about `centre` with these two semi-axes.
PaperPath ellipse(const PaperPoint& centre, const PaperPoint& semi_axis,
                  const PaperPoint& other_semi_axis);

/// Returns the stroke of a straight line.
PaperStroke line_stroke(const PaperPoint& from, const PaperPoint& to, const Colour& colour,
                        double width, const std::vector<double>& dashes = {});

/// A rectangle on paper.
struct PaperBox {
  PaperPoint low = PaperPoint::Constant(1e300),
             high = PaperPoint::Constant(-1e300);  ///< the rectangle is empty at first

  void include(const PaperPoint& p, const PaperPoint& around = PaperPoint::Zero());
  PaperPoint size() const { return high - low; }
};

}  // namespace beeline::internal
