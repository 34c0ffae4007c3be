#pragma once

#include <beeline/draw/internal/chart.h>

namespace beeline::internal {

/// Charts of one width below each other, with an optional picture above them. Neighbouring charts
/// whose x axes have the same name share one axis.
struct ChartColumn {
  std::vector<Chart> charts = {};
  double plot_width = 380;  ///< points
  Picture above = {};
};

/// Columns of charts side by side; all charts have one height.
struct Sheet {
  std::string title = {};
  std::vector<Curve> legend = {};  ///< names and line styles that hold for all charts
  std::vector<ChartColumn> columns = {};
  double plot_height = 76;  ///< points
};

/// Lays the sheet out on a page that contains all of it. Throws Error for a sheet without charts
/// and for values that cannot be drawn.
Picture compose(const Sheet& sheet);

}  // namespace beeline::internal
