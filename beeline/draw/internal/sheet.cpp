#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/axes.h>
#include <beeline/draw/internal/page.h>
#include <beeline/draw/internal/sheet.h>
#include <beeline/error.h>

namespace beeline::internal {
namespace {

constexpr double gap_below = 5, gap_between = 18;  // points

struct ColumnCells {
  const ChartColumn* column = nullptr;
  std::vector<ChartCell> cells;
  double left = 0, right = 0;  ///< widths beside the plots, points

  double width() const { return std::max(left + column->plot_width + right, column->above.width); }
};

ColumnCells cells_of(const ChartColumn& column, double plot_height) {
  ColumnCells result{&column, {}};
  Scale across;
  for (const Chart& chart : column.charts) result.cells.push_back(cell_of(chart));
  for (std::size_t i = 0; i < result.cells.size(); ++i) {
    ChartCell& cell = result.cells[i];
    const bool same = i > 0 && column.charts[i - 1].x_name == column.charts[i].x_name;
    if (!same) {
      across = cell.x;
      for (std::size_t k = i + 1; k < result.cells.size(); ++k) {
        if (column.charts[k].x_name != column.charts[i].x_name) break;
        across.low = std::min(across.low, result.cells[k].x.low);
        across.high = std::max(across.high, result.cells[k].x.high);
      }
      across = spanning(across.low, across.high, 0);
      set_level_ticks(across, column.plot_width, 34);
    } else {
      result.cells[i - 1].numbers_below = false;
    }
    cell.x = across;
    set_upright_ticks(cell.left, plot_height, 13);
    if (cell.has_right) set_upright_ticks(cell.right, plot_height, 13);
    result.left = std::max(result.left, side_width(cell.left));
    if (cell.has_right) result.right = std::max(result.right, side_width(cell.right));
  }
  result.right = std::max(result.right, 8.0);  // the last tick label extends past the plot
  return result;
}

PaperMark moved(PaperMark mark, const PaperPoint& by) {
  if (auto* stroke = std::get_if<PaperStroke>(&mark)) {
    for (PaperPoint& p : stroke->path.points) p += by;
  } else {
    std::get<PaperText>(mark).centre += by;
  }
  return mark;
}

double height_of(const ChartCell& cell, double plot_height) {
  return heading_height(cell) + plot_height + (cell.numbers_below ? numbers_height : 0) + gap_below;
}

double height_of(const ColumnCells& column, double plot_height) {
  double height = column.column->above.height;
  for (const ChartCell& cell : column.cells) height += height_of(cell, plot_height);
  return height;
}

/// Returns the cells of a column, to be drawn in `marks`. The rest of `height` is empty space
/// around the picture, so that all columns end at one height.
std::vector<PageCell> page_cells(ColumnCells& column, double height, double plot_height,
                                 std::vector<PaperMark>& marks) {
  const Picture& above = column.column->above;
  const double spare = above.marks.empty() ? 0 : height - height_of(column, plot_height);
  const PaperPoint centred(std::floor((column.width() - above.width) / 2), std::floor(spare / 2));
  std::vector<PageCell> cells;
  cells.push_back(
      {{column.width(), above.height + spare}, [&above, &marks, centred](const auto& corner) {
         for (const PaperMark& mark : above.marks) {
           marks.push_back(moved(mark, corner + centred));
         }
       }});
  for (ChartCell& cell : column.cells) {
    const auto draw_cell = [&, plot_height](const PaperPoint& corner) {
      cell.plot.low = corner + PaperPoint(column.left, heading_height(cell));
      cell.plot.high = cell.plot.low + PaperPoint(column.column->plot_width, plot_height);
      draw(cell, marks);
    };
    cells.push_back({{column.width(), height_of(cell, plot_height)}, draw_cell});
  }
  return cells;
}

}  // namespace

Picture compose(const Sheet& sheet) {
  std::vector<ColumnCells> columns;
  double width = 0;
  for (const ChartColumn& column : sheet.columns) {
    if (column.charts.empty()) throw Error("a sheet's column has no chart; leave it out");
    columns.push_back(cells_of(column, sheet.plot_height));
    width += columns.back().width() + (columns.size() > 1 ? gap_between : 0);
  }
  if (columns.empty()) throw Error("a sheet needs at least one column");
  Picture picture;
  picture.width = std::ceil(width + 2 * page_margin);
  double top = draw_title(sheet.title, width, picture);
  const double begin = page_margin + columns.front().left;
  top +=
      3 + draw_legend(sheet.legend, {begin, top + 3}, width - columns.front().left, &picture.marks);
  const PaperPoint corner(page_margin, top + 3);
  double height = 0;
  for (const ColumnCells& column : columns) {
    height = std::max(height, height_of(column, sheet.plot_height));
  }
  std::vector<std::vector<PageCell>> cells;
  for (ColumnCells& column : columns) {
    cells.push_back(page_cells(column, height, sheet.plot_height, picture.marks));
  }
  draw_columns(cells, corner, gap_between);
  picture.height = std::ceil(corner.y() + height + page_margin - gap_below);
  return picture;
}

}  // namespace beeline::internal
