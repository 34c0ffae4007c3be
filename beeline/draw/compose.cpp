#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/draw/figure.h>
#include <beeline/draw/labels.h>
#include <beeline/draw/ruler.h>
#include <beeline/draw/symbols.h>
#include <beeline/draw/text.h>
#include <beeline/error.h>

namespace beeline {
namespace {

constexpr double page_margin = 12;
constexpr double column_gap = 20, panel_gap = 14;
constexpr double inner_margin = 8;  // between what is drawn and a plot's edge
constexpr double right_margin = 9;  // half a number may hang over a plot's right edge
constexpr double caption_size = 9, title_size = 12;
constexpr double narrowest = 130, lowest = 70;  // of a plot

/// A panel on its way to paper.
struct Cell {
  const Panel* panel = nullptr;
  std::vector<Polyline> floor;
  std::vector<Foot> feet;
  bool rulers = false;
  // At the scale looked at:
  double scale = 1, step = 1;
  Box extent;  // of the content, in points from the world's origin, y down
  Point plot = Point::Zero();
  double left = 0, below = 0;
  std::vector<std::string> caption;

  double width() const { return left + plot.x() + right_margin; }
  double height() const { return plot.y() + below + caption_height(); }
  double caption_height() const {
    return caption.empty() ? 0 : 5 + 1.35 * caption_size * static_cast<double>(caption.size());
  }
};

using Columns = std::vector<std::vector<Cell>>;

Cell cell_of(const Panel& panel) {
  check_scene(panel.scene);
  Cell cell;
  cell.panel = &panel;
  cell.rulers = has_rulers(panel.view);
  if (!cell.rulers) cell.floor = floor_grid(panel.scene);
  for (const Polyline& line : cell.floor) add_feet(line, 1, cell.feet);
  for (const Item& item : panel.scene.items) {
    if (!panel.labels && std::holds_alternative<Label>(item.shape)) continue;
    add_feet(item.shape, panel.pen, cell.feet);
  }
  if (cell.feet.empty()) cell.feet.emplace_back();
  return cell;
}

/// The content's extent in metres, in the panel's view.
Box metres(const Cell& cell) {
  const Projection projection{cell.panel->view};
  Box box;
  for (const Foot& foot : cell.feet) box.include(projection(foot.at));
  return box;
}

void measure(Cell& cell, double scale) {
  cell.scale = scale * cell.panel->zoom;
  const Projection projection{cell.panel->view, cell.scale};
  cell.extent = {};
  for (const Foot& foot : cell.feet) {
    cell.extent.include(projection(foot.at), foot.around + Point::Constant(inner_margin));
  }
  cell.plot = cell.extent.size().cwiseMax(Point(narrowest, lowest));
  if (!cell.rulers) cell.plot.y() += scale_bar_height;
  const double reach =
      std::max(cell.extent.low.cwiseAbs().maxCoeff(), cell.extent.high.cwiseAbs().maxCoeff());
  cell.step = tick_step(cell.scale, reach / cell.scale);
  cell.below = cell.rulers ? ruler_height : 0;
}

/// The plot's place relative to the world's origin, in points: the content is in its middle.
Box plot_box(const Cell& cell) {
  const Point strip(0, cell.rulers ? 0 : scale_bar_height);
  const Point middle = (cell.extent.low + cell.extent.high + strip) / 2;
  return {middle - cell.plot / 2, middle + cell.plot / 2};
}

void measure_left(Cell& cell) {
  const Box box = plot_box(cell);
  cell.left = cell.rulers
                  ? ruler_width(cell.step, -box.high.y() / cell.scale, -box.low.y() / cell.scale)
                  : right_margin;
}

/// Sizes of all panels at a scale: columns of one width, all of one height. Returns the page's
/// inner size.
Point arrange(Columns& columns, double scale) {
  double height = 0;
  for (auto& column : columns) {
    double width = 0, sum = panel_gap * static_cast<double>(column.size() - 1);
    for (Cell& cell : column) {
      measure(cell, scale);
      measure_left(cell);
      width = std::max(width, cell.width());
    }
    for (Cell& cell : column) {
      cell.caption = wrapped(cell.panel->caption, caption_size, width);
      sum += cell.height();
    }
    height = std::max(height, sum);
  }
  double total = column_gap * static_cast<double>(columns.size() - 1);
  for (auto& column : columns) {
    double sum = panel_gap * static_cast<double>(column.size() - 1), width = 0;
    for (const Cell& cell : column) sum += cell.height();
    for (Cell& cell : column) {
      cell.plot.y() += (height - sum) / static_cast<double>(column.size());
      measure_left(cell);
      width = std::max(width, cell.width());
    }
    for (Cell& cell : column) {
      // Plots of one column stand exactly below each other.
      cell.plot.x() += width - cell.width();
    }
    total += width;
  }
  return {total, height};
}

/// The largest scale, in points per metre, at which the panels fit the page; arranges them so.
Point fit(Columns& columns, const Figure& figure) {
  double span = 0, farthest = 0;
  for (const auto& column : columns) {
    for (const Cell& cell : column) {
      const Box box = metres(cell);
      span = std::max(span, cell.panel->zoom * box.size().maxCoeff());
      farthest =
          std::max({farthest, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()});
    }
  }
  // What is all in one place is shown within a metre, or as much as can be told apart there.
  if (span <= 1e-9 * farthest || span < 1e-12) span = std::max(1.0, 1e-3 * farthest);
  double high = std::max(figure.width, figure.height) / span, low = high / 1000;
  const auto fits = [&](double scale) {
    const Point size = arrange(columns, scale);
    return size.x() <= figure.width && size.y() <= figure.height;
  };
  for (int halving = 0; halving < 40 && high > 1.0001 * low; ++halving) {
    const double middle = std::sqrt(low * high);
    (fits(middle) ? low : high) = middle;
  }
  return arrange(columns, low);
}

/// Far before near within the arm's body; a joint after the links that end in it.
std::vector<const Item*> in_order(const Scene& scene, const Projection& projection, bool by_depth) {
  struct Ordered {
    const Item* item;
    double depth;
  };
  std::vector<Ordered> order;
  for (const Item& item : scene.items) {
    const bool sorted = by_depth && (item.layer == Layer::body || item.layer == Layer::ghost);
    order.push_back({&item, sorted ? depth(item.shape, projection) : 0});
  }
  const auto touches = [](const Item& line, const Vector3& centre) {
    const auto* polyline = std::get_if<Polyline>(&line.shape);
    return polyline != nullptr && !polyline->points.empty() &&
           (polyline->points.front() == centre || polyline->points.back() == centre);
  };
  for (Ordered& joint : order) {
    const auto* symbol = std::get_if<JointSymbol>(&joint.item->shape);
    if (symbol == nullptr || !by_depth) continue;
    for (const Ordered& link : order) {
      if (link.item->layer == joint.item->layer && touches(*link.item, symbol->centre)) {
        joint.depth = std::max(joint.depth, link.depth);
      }
    }
  }
  std::stable_sort(order.begin(), order.end(), [](const Ordered& a, const Ordered& b) {
    return a.item->layer != b.item->layer ? a.item->layer < b.item->layer : a.depth < b.depth;
  });
  std::vector<const Item*> items;
  for (const Ordered& ordered : order) items.push_back(ordered.item);
  return items;
}

void draw_cell(const Cell& cell, const Point& corner, std::vector<Mark>& marks) {
  const Box relative = plot_box(cell);
  Plot plot;
  plot.box.low = corner + Point(cell.left, 0);
  plot.box.high = plot.box.low + cell.plot;
  plot.projection = {cell.panel->view, cell.scale, plot.box.low - relative.low, cell.panel->pen};
  if (cell.rulers) {
    draw_rulers(plot, cell.step, marks);
  } else {
    for (const Polyline& line : cell.floor) draw(line, plot.projection, marks);
    draw_scale_bar(plot, marks);
  }
  const bool from_above = cell.panel->view == top_view() && !cell.panel->scene.floor;
  std::vector<Mark> drawn;
  std::vector<Label> labels;
  for (const Item* item : in_order(cell.panel->scene, plot.projection, !from_above)) {
    std::vector<Mark>& target = item->layer == Layer::ground ? marks : drawn;
    draw(item->shape, plot.projection, target);
    if (const auto* label = std::get_if<Label>(&item->shape)) labels.push_back(*label);
  }
  if (cell.panel->labels) place_labels(labels, plot.projection, drawn);
  marks.insert(marks.end(), drawn.begin(), drawn.end());
  const double middle = (plot.box.low.x() + plot.box.high.x()) / 2;
  double y = plot.box.high.y() + cell.below + 5 + 0.6 * caption_size;
  for (const std::string& line : cell.caption) {
    const double half = text_size(line, caption_size).x() / 2;
    const double x = std::clamp(middle, corner.x() + half,
                                std::max(corner.x() + half, corner.x() + cell.width() - half));
    marks.emplace_back(Text{line, {x, y}, caption_size});
    y += 1.35 * caption_size;
  }
}

}  // namespace

Drawing compose(const Figure& figure) {
  Columns columns;
  for (const auto& panels : figure.columns) {
    if (panels.empty()) throw Error("a figure's column has no panel; leave the column out");
    columns.emplace_back();
    for (const Panel& panel : panels) {
      if (!(panel.zoom > 0 && panel.zoom <= 1e3 && panel.pen > 0 && panel.pen <= 1e3)) {
        throw Error("a panel has zoom " + number(panel.zoom) + " and pen " + number(panel.pen) +
                    "; both must be above 0 and at most 1000");
      }
      columns.back().push_back(cell_of(panel));
    }
  }
  if (columns.empty()) throw Error("a figure needs at least one panel");
  const Point size = fit(columns, figure);
  Drawing drawing;
  drawing.width = std::ceil(size.x() + 2 * page_margin);
  double top = page_margin;
  for (const std::string& line : wrapped(figure.title, title_size, size.x(), true)) {
    Text text{line, {drawing.width / 2, top + 0.6 * title_size}, title_size};
    text.bold = true;
    drawing.marks.emplace_back(text);
    top += 1.35 * title_size;
  }
  if (!figure.title.empty()) top += 5;
  drawing.height = std::ceil(top + size.y() + page_margin);
  Point corner((drawing.width - size.x()) / 2, top);
  for (const auto& column : columns) {
    corner.y() = top;
    for (const Cell& cell : column) {
      draw_cell(cell, corner, drawing.marks);
      corner.y() += cell.height() + panel_gap;
    }
    corner.x() += column.front().width() + column_gap;
  }
  return drawing;
}

}  // namespace beeline
