#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/draw/internal/labels.h>
#include <beeline/draw/internal/text.h>

namespace beeline::internal {
namespace {

struct StrokeSegment {
  Point from, to;
  double half_width = 0;
};

std::vector<StrokeSegment> segments_of(const std::vector<Mark>& marks) {
  std::vector<StrokeSegment> segments;
  for (const Mark& mark : marks) {
    const auto* stroke = std::get_if<Stroke>(&mark);
    if (stroke == nullptr) continue;
    const std::vector<Point>& points = stroke->path.points;
    std::size_t next = 0;
    for (const Path::Verb verb : stroke->path.verbs) {
      const std::size_t count = verb == Path::Verb::curve ? 3 : verb == Path::Verb::close ? 0 : 1;
      for (std::size_t i = 0; i < count; ++i, ++next) {
        const Point& before = verb == Path::Verb::move ? points[next] : points[next - 1];
        segments.push_back({before, points[next], stroke->width / 2});
      }
    }
  }
  return segments;
}

/// Returns the length of the segment inside the box (Liang & Barsky 1984) plus 2 points, so that a
/// segment that only touches it counts too; 0 when it is outside.
double length_inside(const StrokeSegment& segment, const Box& box) {
  double enter = 0, leave = 1;
  const Point direction = segment.to - segment.from;
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

double common_area(const Box& a, const Box& b) {
  const Point size = a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low);
  return size.x() > 0 && size.y() > 0 ? size.x() * size.y() : 0;
}

}  // namespace

void place_labels(const std::vector<Label>& labels, const Projection& projection,
                  std::vector<Mark>& marks) {
  const std::vector<StrokeSegment> segments = segments_of(marks);
  std::vector<Box> taken;
  for (const Label& label : labels) {
    const Point anchor = projection(label.at);
    const Point half = text_size(label.text, label.size) / 2;
    const double wanted = std::atan2(label.up, label.right);
    double lowest_cost = 1e300;
    Text best{drawable(label.text), anchor, label.size, label.colour};
    best.halo = true;
    Box best_box;
    for (const double gap : {5.0, 11.0, 17.0, farthest_label}) {
      constexpr int directions = 16;
      for (int k = 0; k < directions; ++k) {
        const int steps = k % 2 == 0 ? k / 2 : -(k + 1) / 2;  // to either side in turn
        const double offset = 2 * std::numbers::pi * steps / directions;
        const Point direction(std::cos(wanted + offset), -std::sin(wanted + offset));
        const Point centre = anchor + direction * gap + direction.cwiseProduct(half);
        Box box;
        box.include(centre, half + Point(1, -0.5));
        double cost = 0.35 * gap + 1.6 * std::abs(offset);
        for (const StrokeSegment& segment : segments) cost += length_inside(segment, box);
        for (const Box& other : taken) cost += 5 * common_area(box, other);
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
