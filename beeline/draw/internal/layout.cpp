#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/axes.h>
#include <beeline/draw/internal/page_layout.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/ruler.h>
#include <beeline/draw/internal/text.h>

namespace beeline::internal {
namespace {

constexpr double inner_margin = 8;  // margin between the content and the edge of a plot
constexpr double right_margin = 9;  // room for half a tick label past the right edge
constexpr double min_width = 130, min_height = 70;  // min size of a plot

/// Returns the extent of the content in metres, in the view of the panel.
PaperBox metres(const Cell& cell) {
  const Projection projection{cell.panel->view};
  PaperBox box;
  for (const Footprint& footprint : cell.footprints) box.include(projection(footprint.at));
  return box;
}

void measure_content(Cell& cell, double scale) {
  cell.scale = scale * cell.panel->zoom;
  const Projection projection{cell.panel->view, cell.scale};
  cell.extent = {};
  for (const Footprint& footprint : cell.footprints) {
    cell.extent.include(projection(footprint.at),
                        footprint.around + PaperPoint::Constant(inner_margin));
  }
}

/// Gives panels with the same horizontal (0) or vertical (1) ruler the same range on it.
void equalise_range(const std::vector<Cell*>& cells, int axis) {
  const auto same = [axis](const Cell& a, const Cell& b) {
    return a.rulers && b.rulers && a.scale == b.scale &&
           a.panel->view.row(axis) == b.panel->view.row(axis);
  };
  for (const Cell* first : cells) {
    double low = first->extent.low[axis], high = first->extent.high[axis];
    for (const Cell* cell : cells) {
      if (!same(*first, *cell)) continue;
      low = std::min(low, cell->extent.low[axis]);
      high = std::max(high, cell->extent.high[axis]);
    }
    for (Cell* cell : cells) {
      if (!same(*first, *cell)) continue;
      cell->extent.low[axis] = low;
      cell->extent.high[axis] = high;
    }
  }
}

void measure_plot(Cell& cell) {
  cell.plot = cell.extent.size().cwiseMax(PaperPoint(min_width, min_height));
  if (cell.scale_bar) cell.plot.y() += scale_bar_height;
  const double reach =
      std::max(cell.extent.low.cwiseAbs().maxCoeff(), cell.extent.high.cwiseAbs().maxCoeff());
  cell.step = tick_step(cell.scale, reach / cell.scale);
  cell.below = cell.rulers ? numbers_height : 0;
}

/// Sets the width left of the plots, equal for all plots of a column, so that they align.
void measure_left(std::vector<Cell>& column) {
  double left = 0;
  for (const Cell& cell : column) {
    const double width =
        cell.rulers ? side_width(ruler(plot_box(cell), 1, cell.scale, cell.step)) : right_margin;
    left = std::max(left, width);
  }
  for (Cell& cell : column) cell.left = left;
}

double height_of(const std::vector<Cell>& column) {
  double height = panel_gap * static_cast<double>(column.size() - 1);
  for (const Cell& cell : column) height += cell.height();
  return height;
}

void measure(Columns& columns, double scale) {
  std::vector<Cell*> row;  // panels that are alone in their column
  for (auto& column : columns) {
    std::vector<Cell*> cells;
    for (Cell& cell : column) {
      measure_content(cell, scale);
      cells.push_back(&cell);
    }
    equalise_range(cells, 0);
    if (cells.size() == 1) row.push_back(cells.front());
  }
  equalise_range(row, 1);
  for (auto& column : columns) {
    for (Cell& cell : column) measure_plot(cell);
    measure_left(column);
  }
}

/// Sets the sizes of all panels at a scale: the panels of a column get one width, all columns one
/// height, at least `min_size` in all. Returns the total size.
PaperPoint arrange(Columns& columns, double scale,
                   const PaperPoint& min_size = PaperPoint::Zero()) {
  measure(columns, scale);
  PaperPoint page(column_gap * static_cast<double>(columns.size() - 1), 0);
  double plots = page.x();
  for (auto& column : columns) plots += width_of(column);
  for (auto& column : columns) {
    const double spare = (min_size.x() - plots) / static_cast<double>(columns.size());
    for (Cell& cell : column) cell.plot.x() += std::max(0.0, spare);
  }
  for (auto& column : columns) {
    const double width = width_of(column);
    for (Cell& cell : column) cell.caption = balanced(cell.panel->caption, caption_size, width);
    page.y() = std::max(page.y(), height_of(column));
  }
  page.y() = std::max(page.y(), min_size.y());
  for (auto& column : columns) {
    const double spare = page.y() - height_of(column);
    for (Cell& cell : column) cell.plot.y() += spare / static_cast<double>(column.size());
    measure_left(column);  // taller plots may have longer tick labels
    const double width = width_of(column);
    for (Cell& cell : column) cell.plot.x() += width - cell.width();
    page.x() += width;
  }
  // Taller plots have longer tick labels, which reduce the width.
  const double wider = (min_size.x() - page.x()) / static_cast<double>(columns.size());
  if (min_size.x() == 0) return page;
  for (auto& column : columns) {
    for (Cell& cell : column) cell.plot.x() = std::max(min_width, cell.plot.x() + wider);
  }
  page.x() = column_gap * static_cast<double>(columns.size() - 1);
  for (const auto& column : columns) page.x() += width_of(column);
  return page;
}

}  // namespace

double Cell::caption_height() const {
  return caption.empty() ? 0 : 5 + caption_leading * static_cast<double>(caption.size());
}
double Cell::width() const { return left + plot.x() + right_margin; }
double Cell::height() const { return plot.y() + below + caption_height(); }

PaperBox plot_box(const Cell& cell) {
  const PaperPoint strip(0, cell.scale_bar ? scale_bar_height : 0);
  const PaperPoint middle = (cell.extent.low + cell.extent.high + strip) / 2;
  return {middle - cell.plot / 2, middle + cell.plot / 2};
}

double width_of(const std::vector<Cell>& column) {
  double width = 0;
  for (const Cell& cell : column) width = std::max(width, cell.width());
  return width;
}

PaperPoint fit(Columns& columns, const PaperPoint& page, bool fill) {
  double span = 0, farthest = 0;
  for (const auto& column : columns) {
    for (const Cell& cell : column) {
      const PaperBox box = metres(cell);
      span = std::max(span, cell.panel->zoom * box.size().maxCoeff());
      farthest =
          std::max({farthest, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()});
    }
  }
  // Content at a single point is shown within a metre, or within the resolution of its coordinates.
  if (span <= 1e-9 * farthest || span < 1e-12) span = std::max(1.0, 1e-3 * farthest);
  double high = std::max(page.x(), page.y()) / span, low = high / 1000;
  const auto fits = [&](double scale) {
    const PaperPoint size = arrange(columns, scale);
    return size.x() <= page.x() && size.y() <= page.y();
  };
  for (int halving = 0; halving < 40 && high > 1.0001 * low; ++halving) {
    const double middle = std::sqrt(low * high);
    (fits(middle) ? low : high) = middle;
  }
  return arrange(columns, low, fill ? page : PaperPoint::Zero());
}

}  // namespace beeline::internal
