#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/draw/internal/labels.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/text.h>

namespace beeline::internal {
namespace {

struct StrokeSegment {
  PaperPoint from, to;
  double half_width = 0;
};

std::vector<StrokeSegment> segments_of(const std::vector<PaperMark>& marks) {
  std::vector<StrokeSegment> segments;
  for (const PaperMark& mark : marks) {
    const auto* stroke = std::get_if<PaperStroke>(&mark);
    if (stroke == nullptr) continue;
    const std::vector<PaperPoint>& points = stroke->path.points;
    std::size_t next = 0;
    for (const PaperPath::Verb verb : stroke->path.verbs) {
      const std::size_t count = verb == PaperPath::Verb::curve   ? 3
                                : verb == PaperPath::Verb::close ? 0
                                                                 : 1;
      for (std::size_t i = 0; i < count; ++i, ++next) {
        const PaperPoint& before = verb == PaperPath::Verb::move ? points[next] : points[next - 1];
        segments.push_back({before, points[next], stroke->width / 2});
      }
    }
  }
  return segments;
}

/// Returns the length of the segment inside the box (Liang & Barsky 1984) plus 2 points, so that a
/// segment that only touches it counts too; 0 when it is outside.
double length_inside(const StrokeSegment& segment, const PaperBox& box) {
  double enter = 0, leave = 1;
  const PaperPoint direction = segment.to - segment.from;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = box.low[axis] - segment.half_width - segment.from[axis];
    const double high = box.high[axis] + segment.half_width - segment.from[axis];
    if (direction[axis] == 0) {
      if (low > 0 || high < 0) return 0;
      continue;
    }
    const double a = low / direction[axis], b = high / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter > leave ? 0 : 2 + (leave - enter) * direction.norm();
}

double common_area(const PaperBox& a, const PaperBox& b) {
  const PaperPoint size = a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low);
  return size.x() > 0 && size.y() > 0 ? size.x() * size.y() : 0;
}

}  // namespace

void place_labels(const std::vector<Label>& labels, const Projection& projection,
                  std::vector<PaperMark>& marks) {
  const std::vector<StrokeSegment> segments = segments_of(marks);
  std::vector<PaperBox> taken;
  for (const Label& label : labels) {
    const PaperPoint anchor = projection(label.at);
    const PaperPoint half = text_size(label.text, label.size) / 2;
    const double wanted = std::atan2(label.up, label.right);
    double lowest_cost = 1e300;
    PaperText best{drawable(label.text), anchor, label.size, label.colour};
    best.halo = true;
    PaperBox best_box;
    for (const double gap : {5.0, 11.0, 17.0, farthest_label}) {
      constexpr int directions = 16;
      for (int k = 0; k < directions; ++k) {
        const int steps = k % 2 == 0 ? k / 2 : -(k + 1) / 2;  // to either side in turn
        const double offset = 2 * std::numbers::pi * steps / directions;
        const PaperPoint direction(std::cos(wanted + offset), -std::sin(wanted + offset));
        const PaperPoint centre = anchor + direction * gap + direction.cwiseProduct(half);
        PaperBox box;
        box.include(centre, half + PaperPoint(1, -0.5));
        double cost = 0.35 * gap + 1.6 * std::abs(offset);
        for (const StrokeSegment& segment : segments) cost += length_inside(segment, box);
        for (const PaperBox& other : taken) cost += 5 * common_area(box, other);
        if (cost >= lowest_cost) continue;
        lowest_cost = cost;
        best.centre = centre;
        best_box = box;
      }
    }
    taken.push_back(best_box);
    marks.emplace_back(best);
  }
}

}  // namespace beeline::internal
