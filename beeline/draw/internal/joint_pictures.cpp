#include <cmath>
#include <numbers>

#include <beeline/draw/internal/concept_figures.h>
#include <beeline/error.h>

namespace beeline::internal {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double bar_width = 10, symbol_size = 15;  // points

View joint_view() { return oblique_view(-0.95, 0.5); }

void add_bar(Drawing& drawing, const Vector3& from, const Vector3& to, bool is_faded = false) {
  drawing.add(is_faded ? Layer::ghost : Layer::body, Polyline{{from, to},
                                                              is_faded ? faded(steel) : steel,
                                                              bar_width,
                                                              {},
                                                              1.2,
                                                              is_faded ? faded(ink) : ink});
}

void add_arrow(Drawing& drawing, std::vector<Vector3> points) {
  Polyline arrow{std::move(points), amber, 1.8};
  arrow.arrow = true;
  drawing.add(Layer::mark, arrow);
}

/// Adds arrows from `from` in both directions along `direction`.
void add_both_ways(Drawing& drawing, const Vector3& from, const Vector3& direction) {
  add_arrow(drawing, {from, from + direction});
  add_arrow(drawing, {from, from - direction});
}

/// Adds an arrow about the axis through `centre` along the unit vector `axis`, in front of it,
/// which moves along the axis by `rise`.
void add_turn(Drawing& drawing, const Vector3& centre, const Vector3& axis, double radius,
              double rise = 0, double turn = 1.35 * pi) {
  const Vector3 viewer = joint_view().row(2).transpose();
  const Vector3 front = (viewer - viewer.dot(axis) * axis).normalized(), side = axis.cross(front);
  std::vector<Vector3> points;
  constexpr int steps = 60;
  for (int k = 0; k <= steps; ++k) {
    const double part = static_cast<double>(k) / steps - 0.5, angle = turn * part;
    points.emplace_back(centre + radius * (std::cos(angle) * front + std::sin(angle) * side) +
                        rise * part * axis);
  }
  add_arrow(drawing, points);
}

void add_symbol(Drawing& drawing, JointKind kind, const Vector3& axis, double size = symbol_size) {
  drawing.add(Layer::body, JointSymbol{kind, Vector3::Zero(), axis, 0, size});
}

void add_spherical(Drawing& drawing) {
  const Vector3 z = Vector3::UnitZ();
  add_bar(drawing, -z, Vector3::Zero());
  add_bar(drawing, Vector3::Zero(), {0.75, 0, 0.75});
  drawing.add(Layer::base, Dots{{Vector3::Zero()}, ink, 37});
  drawing.add(Layer::mark, Dots{{Vector3::Zero()}, ink, 37});
  drawing.add(Layer::mark, Dots{{Vector3::Zero()}, paper_white, 34.5});
  const double radius = 0.85;
  add_turn(drawing, Vector3::Zero(), z, radius);
  add_turn(drawing, Vector3::Zero(), Vector3::UnitX(), radius, 0, 1.1 * pi);
  add_turn(drawing, Vector3::Zero(), -Vector3::UnitY(), radius, 0, 1.1 * pi);
}

void add_planar(Drawing& drawing) {
  std::vector<Vector3> plate{{-1, -0.8, 0}, {1, -0.8, 0}, {1, 0.8, 0}, {-1, 0.8, 0}, {-1, -0.8, 0}};
  drawing.add(Layer::ground, Polyline{plate, ink, 1.1});
  for (const double x : {-0.5, 0.0, 0.5}) {
    drawing.add(Layer::ground, Polyline{{{x, -0.8, 0}, {x, 0.8, 0}}, faded(ink), 0.7});
  }
  drawing.add(Layer::ground, Polyline{{{-1, 0, 0}, {1, 0, 0}}, faded(ink), 0.7});
  add_bar(drawing, {0, 0, 0.12}, {0, 0, 0.9});
  drawing.add(Layer::body, JointSymbol{JointKind::prismatic, {0, 0, 0.12}, Vector3::UnitZ(), 0, 9});
  add_both_ways(drawing, {-0.25, -0.55, 0}, {0.55, 0, 0});
  add_both_ways(drawing, {0.72, 0.12, 0}, {0, 0.5, 0});
  add_turn(drawing, {0, 0, 0.75}, Vector3::UnitZ(), 0.4);
}

void add_joint(Drawing& drawing, char type) {
  const Vector3 z = Vector3::UnitZ(), x = Vector3::UnitX();
  if (type == 'S') return add_spherical(drawing);
  if (type == 'E') return add_planar(drawing);
  const Vector3 axis = type == 'P' ? x : z;
  add_bar(drawing, -axis, Vector3::Zero());
  add_bar(drawing, Vector3::Zero(), axis);
  if (type == 'P') {
    add_symbol(drawing, JointKind::prismatic, axis);
    add_both_ways(drawing, {0, 0, 0.65}, 0.8 * axis);
    return;
  }
  add_symbol(drawing, type == 'H' ? JointKind::helical : JointKind::revolute, axis);
  if (type == 'C') add_both_ways(drawing, {0.75, 0, 0}, 0.75 * axis);
  const Vector3 above = (type == 'H' ? 0.78 : 0.8) * axis;
  add_turn(drawing, above, axis, 0.45, type == 'H' ? 0.45 : 0, type == 'H' ? 2.6 * pi : 1.35 * pi);
}

Panel panel_of(Drawing drawing, const std::string& caption) {
  Panel panel{.drawing = std::move(drawing), .view = joint_view(), .caption = caption};
  panel.axes = false;
  return panel;
}

}  // namespace

Panel joint_picture(char type, const std::string& caption) {
  Drawing drawing;
  add_joint(drawing, type);
  return panel_of(std::move(drawing), caption);
}

Panel linked_joint(JointKind kind, const std::string& caption) {
  Drawing drawing;
  const Vector3 x = Vector3::UnitX(), z = Vector3::UnitZ();
  const auto label = [&](const Vector3& at, const std::string& text, double right, double up) {
    drawing.add(Layer::note, Label{at, text, ink, 9, right, up});
  };
  add_bar(drawing, -2 * x, Vector3::Zero());
  label(-1.2 * x, "link i − 1", -0.3, 1);
  const bool slides = kind == JointKind::prismatic;
  const auto second_link = [&](double q) {
    return Vector3(slides ? (1 + q) * x : 2 * Vector3(std::cos(q), std::sin(q), 0));
  };
  add_bar(drawing, Vector3::Zero(), second_link(slides ? 1.4 : -0.6), true);
  add_bar(drawing, Vector3::Zero(), second_link(slides ? 0.6 : 0.75));
  add_symbol(drawing, kind, slides ? x : z, 16);
  if (slides) {
    add_both_ways(drawing, {1.2, 0, 0.7}, 0.7 * x);
    label({1.2, 0, 0.7}, "dᵢ", 0, 1);
  } else {
    drawing.add(Layer::mark, Polyline{{-0.9 * z, 1.3 * z}, construction_grey, 0.9, {5, 2.5}});
    std::vector<Vector3> arc;
    for (int k = 0; k <= 40; ++k) arc.push_back(0.62 * second_link(-0.6 + 1.35 * k / 40));
    add_arrow(drawing, arc);
    label(arc[20], "θᵢ", 1, -0.6);
  }
  label(second_link(slides ? 0.5 : 0.75), "link i", 0.6, 1);
  return panel_of(std::move(drawing), caption);
}

}  // namespace beeline::internal
