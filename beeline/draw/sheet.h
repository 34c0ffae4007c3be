#pragma once

#include <beeline/draw/chart.h>

namespace beeline {

/// Charts below each other, with one width, and perhaps a picture above them. Charts whose x axis
/// has one name share it.
struct ChartColumn {
  std::vector<Chart> charts = {};
  double plot_width = 380;  ///< points
  Drawing above = {};
};

/// Columns side by side; all charts are equally high.
struct Sheet {
  std::string title = {};
  std::vector<Curve> key = {};  ///< whose names and lines hold for all charts
  std::vector<ChartColumn> columns = {};
  double plot_height = 76;  ///< points
};

/// The sheet on paper: everything lies within the page. Throws Error for a sheet without charts,
/// and for values that cannot be drawn.
Drawing compose(const Sheet& sheet);

}  // namespace beeline
