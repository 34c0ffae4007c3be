#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/labels.h>
#include <beeline/draw/internal/page.h>
#include <beeline/draw/internal/page_layout.h>
#include <beeline/draw/internal/ruler.h>
#include <beeline/draw/internal/symbols.h>
#include <beeline/draw/internal/text.h>
#include <beeline/error.h>

namespace beeline::internal {
namespace {

Cell cell_of(const Panel& panel, std::span<const Drawing> frames) {
  check_drawing(panel.drawing);
  Cell cell;
  cell.panel = &panel;
  cell.rulers = panel.axes && has_rulers(panel.view);
  cell.scale_bar = panel.axes && !cell.rulers;
  if (cell.scale_bar) cell.floor = floor_grid(panel.drawing, frames);
  for (const Polyline& line : cell.floor) add_footprints(line, 1, cell.footprints);
  const auto add = [&](const Drawing& drawing) {
    for (const Item& item : drawing.items) {
      if (!panel.labels && std::holds_alternative<Label>(item.shape)) continue;
      add_footprints(item.shape, panel.pen, cell.footprints);
    }
  };
  add(panel.drawing);
  for (const Drawing& frame : frames) add(frame);
  if (cell.footprints.empty()) cell.footprints.emplace_back();
  return cell;
}

struct Sourced {
  const Item* item;
  MarkSource source;
};

void add_all(const Drawing& drawing, MarkSource::Kind kind, const auto& add) {
  for (std::size_t i = 0; i < drawing.items.size(); ++i)
    add(drawing.items[i], MarkSource{kind, 0, i});
}

/// Returns the items in order of drawing: by layer; within the arm's body from far to near, with a
/// joint after the links that end in it.
std::vector<Sourced> in_order(const Cell& cell, const Drawing* frame,
                              const Projection& projection) {
  struct Ordered {
    const Item* item;
    double depth;
    MarkSource source;
  };
  std::vector<Ordered> order;
  const auto add = [&](const Item& item, const MarkSource& source) {
    const bool sorted = item.layer == Layer::body || item.layer == Layer::ghost;
    // Depths are rounded to hundredths of a point, so that rounding errors do not decide what is
    // covered.
    const double far = 100 * projection.scale * depth(item.shape, projection);
    order.push_back({&item, sorted ? std::round(far) : 0, source});
  };
  add_all(cell.panel->drawing, MarkSource::Kind::still, add);
  if (frame != nullptr) add_all(*frame, MarkSource::Kind::moving, add);
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
  std::vector<Sourced> items;
  for (const Ordered& ordered : order) items.push_back({ordered.item, ordered.source});
  return items;
}

Plot plot_of(const Cell& cell, const PaperPoint& corner) {
  const PaperBox relative = plot_box(cell);
  Plot plot;
  plot.box.low = corner + PaperPoint(cell.left, 0);
  plot.box.high = plot.box.low + cell.plot;
  plot.projection = {cell.panel->view, cell.scale, plot.box.low - relative.low, cell.panel->pen,
                     plot.box};
  return plot;
}

std::vector<PaperMark> background(const Cell& cell, const Plot& plot) {
  std::vector<PaperMark> marks;
  if (cell.rulers) {
    draw_rulers(plot, cell.step, marks);
  } else if (cell.scale_bar) {
    for (const Polyline& line : cell.floor) draw(line, plot.projection, marks);
    draw_scale_bar(plot, marks);
  }
  return marks;
}

std::vector<PaperMark> caption(const Cell& cell, const Plot& plot, const PaperPoint& corner) {
  std::vector<PaperMark> marks;
  const double middle = (plot.box.low.x() + plot.box.high.x()) / 2;
  double y = plot.box.high.y() + cell.below + 5 + 0.6 * caption_size;
  for (const std::string& line : cell.caption) {
    const double half = text_size(line, caption_size).x() / 2;
    const double x = std::clamp(middle, corner.x() + half,
                                std::max(corner.x() + half, corner.x() + cell.width() - half));
    marks.emplace_back(PaperText{line, {x, y}, caption_size});
    y += caption_leading;
  }
  return marks;
}

/// Places the labels of the panel beside its marks at the beginning and at the end.
std::vector<PaperMark> placed_labels(const Cell& cell, const PaperPoint& corner,
                                     std::span<const Drawing> frames) {
  if (!cell.panel->labels) return {};
  const Plot plot = plot_of(cell, corner);
  std::vector<PaperMark> drawn;
  std::vector<Label> labels;
  const auto draw_items = [&](const Drawing* frame) {
    for (const Sourced& sourced : in_order(cell, frame, plot.projection)) {
      if (sourced.item->layer == Layer::ground) continue;
      draw(sourced.item->shape, plot.projection, drawn);
      const auto* label = std::get_if<Label>(&sourced.item->shape);
      if (label != nullptr) labels.push_back(*label);
    }
  };
  draw_items(frames.empty() ? nullptr : &frames.back());
  if (frames.size() > 1) {
    const std::vector<Label> once = labels;
    draw_items(&frames.front());
    labels = once;
  }
  const auto shapes = static_cast<std::ptrdiff_t>(drawn.size());
  place_labels(labels, plot.projection, drawn);
  return {drawn.begin() + shapes, drawn.end()};
}

std::vector<FrameMark> frame_marks_of(std::vector<PaperMark> drawn, const MarkSource& source,
                                      double appears = 0) {
  std::vector<FrameMark> marks;
  for (PaperMark& mark : drawn) {
    marks.push_back({std::make_shared<const PaperMark>(std::move(mark)), source, appears});
  }
  return marks;
}

std::vector<FrameMark> marks_of(const Item& item, const Projection& projection,
                                const MarkSource& source) {
  std::vector<PaperMark> drawn;
  draw(item.shape, projection, drawn);
  return frame_marks_of(std::move(drawn), source, item.appears);
}

/// A cell with the marks that all frames share.
PageLayout::PlacedCell placed_cell(const Cell& cell, const PaperPoint& corner, std::size_t panel,
                                   std::span<const Drawing> frames) {
  const Plot plot = plot_of(cell, corner);
  const auto source = [panel](MarkSource::Kind kind) { return MarkSource{kind, panel}; };
  PageLayout::PlacedCell placed{.cell = cell, .corner = corner};
  placed.background = frame_marks_of(background(cell, plot), source(MarkSource::Kind::background));
  placed.labels =
      frame_marks_of(placed_labels(cell, corner, frames), source(MarkSource::Kind::label));
  placed.caption = frame_marks_of(caption(cell, plot, corner), source(MarkSource::Kind::caption));
  const std::vector<Item>& items = cell.panel->drawing.items;
  for (std::size_t i = 0; i < items.size(); ++i) {
    placed.still.push_back(
        marks_of(items[i], plot.projection, {MarkSource::Kind::still, panel, i}));
  }
  return placed;
}

void draw_cell(const PageLayout::PlacedCell& placed, std::size_t panel, const Drawing* frame,
               std::vector<FrameMark>& marks) {
  const Plot plot = plot_of(placed.cell, placed.corner);
  const auto add = [&marks](const std::vector<FrameMark>& drawn) {
    marks.insert(marks.end(), drawn.begin(), drawn.end());
  };
  add(placed.background);
  for (Sourced& sourced : in_order(placed.cell, frame, plot.projection)) {
    sourced.source.panel = panel;
    if (sourced.source.kind == MarkSource::Kind::still) {
      add(placed.still[sourced.source.item]);
    } else {
      add(marks_of(*sourced.item, plot.projection, sourced.source));
    }
  }
  add(placed.labels);
  add(placed.caption);
}

void check_figure(const Figure& figure) {
  for (const double side : {figure.width, figure.height}) {
    if (side >= 100 && side <= 10000) continue;
    throw Error("a page of " + number(figure.width) + " by " + number(figure.height) +
                " points cannot be drawn; each side must be between 100 and 10000");
  }
  if (figure.columns.empty()) throw Error("a figure needs at least one panel");
  for (const auto& panels : figure.columns) {
    if (panels.empty()) throw Error("a figure's column has no panel; leave the column out");
    for (const Panel& panel : panels) {
      if (panel.zoom > 0 && panel.zoom <= 1e3 && panel.pen > 0 && panel.pen <= 1e3) continue;
      throw Error("a panel has zoom " + number(panel.zoom) + " and pen " + number(panel.pen) +
                  "; both must be above 0 and at most 1000");
    }
  }
}

}  // namespace

PageLayout laid_out(const Figure& figure, std::span<const Drawing> frames) {
  check_figure(figure);
  for (const Drawing& frame : frames) check_drawing(frame);
  Columns columns;
  for (const auto& panels : figure.columns) {
    columns.emplace_back();
    for (const Panel& panel : panels) columns.back().push_back(cell_of(panel, frames));
  }
  const PaperPoint size = fit(columns, {figure.width, figure.height}, figure.fill);
  PageLayout layout;
  layout.width = std::ceil(size.x() + 2 * page_margin);
  Picture title;
  title.width = layout.width;
  double top = draw_title(figure.title, size.x(), title);
  layout.title = frame_marks_of(std::move(title.marks), {});
  if (!figure.title.empty()) top += 5;
  layout.height = std::ceil(top + size.y() + page_margin);
  std::vector<std::vector<PageCell>> cells(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (const Cell& cell : columns[i]) {
      const auto place = [&](const PaperPoint& corner) {
        layout.cells.push_back(placed_cell(cell, corner, layout.cells.size(), frames));
      };
      cells[i].push_back({{cell.width(), cell.height() + panel_gap}, place});
    }
  }
  draw_columns(cells, {(layout.width - size.x()) / 2, top}, column_gap);
  return layout;
}

std::vector<FrameMark> frame_marks(const PageLayout& layout, const Drawing* frame) {
  std::vector<FrameMark> marks = layout.title;
  for (std::size_t i = 0; i < layout.cells.size(); ++i) {
    draw_cell(layout.cells[i], i, frame, marks);
  }
  return marks;
}

}  // namespace beeline::internal
