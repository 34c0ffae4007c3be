#include <algorithm>
#include <cmath>

#include <beeline/draw/figure.h>
#include <beeline/draw/internal/labels.h>
#include <beeline/draw/internal/layout.h>
#include <beeline/draw/internal/page.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/ruler.h>
#include <beeline/draw/internal/symbols.h>
#include <beeline/draw/internal/text.h>
#include <beeline/error.h>

namespace beeline {
using namespace internal;
namespace {

Cell cell_of(const Panel& panel) {
  check_scene(panel.scene);
  Cell cell;
  cell.panel = &panel;
  cell.rulers = has_rulers(panel.view);
  if (!cell.rulers) cell.floor = floor_grid(panel.scene);
  for (const Polyline& line : cell.floor) add_footprints(line, 1, cell.footprints);
  for (const Item& item : panel.scene.items) {
    if (!panel.labels && std::holds_alternative<Label>(item.shape)) continue;
    add_footprints(item.shape, panel.pen, cell.footprints);
  }
  if (cell.footprints.empty()) cell.footprints.emplace_back();
  return cell;
}

/// Returns the items in order of drawing: by layer, within the arm's body from far to near, and a
/// joint after the links that end in it.
std::vector<const Item*> in_order(const Scene& scene, const Projection& projection) {
  struct Ordered {
    const Item* item;
    double depth;
  };
  std::vector<Ordered> order;
  for (const Item& item : scene.items) {
    const bool sorted = item.layer == Layer::body || item.layer == Layer::ghost;
    // Rounded to hundredths of a point, so that rounding errors do not decide what covers what.
    const double far = 100 * projection.scale * depth(item.shape, projection);
    order.push_back({&item, sorted ? std::round(far) : 0});
  }
  const auto touches = [](const Item& line, const Vector3& centre) {
    const auto* polyline = std::get_if<Polyline>(&line.shape);
    return polyline != nullptr && !polyline->points.empty() &&
           (polyline->points.front() == centre || polyline->points.back() == centre);
  };
  for (Ordered& joint : order) {
    const auto* symbol = std::get_if<JointSymbol>(&joint.item->shape);
    if (symbol == nullptr) continue;
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

void draw_cell(const Cell& cell, const PaperPoint& corner, std::vector<PaperMark>& marks) {
  const PaperBox relative = plot_box(cell);
  Plot plot;
  plot.box.low = corner + PaperPoint(cell.left, 0);
  plot.box.high = plot.box.low + cell.plot;
  plot.projection = {cell.panel->view, cell.scale, plot.box.low - relative.low, cell.panel->pen};
  if (cell.rulers) {
    draw_rulers(plot, cell.step, marks);
  } else {
    for (const Polyline& line : cell.floor) draw(line, plot.projection, marks);
    draw_scale_bar(plot, marks);
  }
  std::vector<PaperMark> drawn;
  std::vector<Label> labels;
  for (const Item* item : in_order(cell.panel->scene, plot.projection)) {
    std::vector<PaperMark>& target = item->layer == Layer::ground ? marks : drawn;
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
    marks.emplace_back(PaperText{line, {x, y}, caption_size});
    y += caption_leading;
  }
}

}  // namespace

View top_view() { return View::Identity(); }

View front_view() {
  View view;
  view << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return view;
}

View side_view() {
  View view;
  view << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return view;
}

View oblique_view(double azimuth, double elevation) {
  if (!std::isfinite(azimuth) || !std::isfinite(elevation)) {
    throw Error("azimuth " + number(azimuth) + " and elevation " + number(elevation) +
                " of a view must be finite angles");
  }
  const double ca = std::cos(azimuth), sa = std::sin(azimuth);
  const double ce = std::cos(elevation), se = std::sin(elevation);
  View view;
  view << -sa, ca, 0, -se * ca, -se * sa, ce, ce * ca, ce * sa, se;
  return view;
}

Drawing compose(const Figure& figure) {
  for (const double side : {figure.width, figure.height}) {
    if (side >= 100 && side <= 10000) continue;
    throw Error("a page of " + number(figure.width) + " by " + number(figure.height) +
                " points cannot be drawn; each side must be between 100 and 10000");
  }
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
  const PaperPoint size = fit(columns, {figure.width, figure.height});
  Drawing drawing;
  drawing.width = std::ceil(size.x() + 2 * page_margin);
  double top = draw_title(figure.title, size.x(), drawing);
  if (!figure.title.empty()) top += 5;
  drawing.height = std::ceil(top + size.y() + page_margin);
  PaperPoint corner((drawing.width - size.x()) / 2, top);
  for (const auto& column : columns) {
    corner.y() = top;
    for (const Cell& cell : column) {
      draw_cell(cell, corner, drawing.marks);
      corner.y() += cell.height() + panel_gap;
    }
    corner.x() += width_of(column) + column_gap;
  }
  return drawing;
}

}  // namespace beeline
