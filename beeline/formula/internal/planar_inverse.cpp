#include <algorithm>
#include <optional>

#include <beeline/formula/internal/inverse_steps.h>
#include <beeline/formula/internal/planar_inverse.h>

namespace beeline::internal {
namespace {

/// Solves for two joints that bring a point to (u, v).
void solve_two(InverseSteps& steps, const PlanarLink& one, const PlanarLink& two,
               const Expression& u, const Expression& v) {
  if (one.revolute && two.revolute) {
    const Expression a = one.length, b = two.length;
    const Expression c = steps.define("c", "2", over(u * u + v * v - a * a - b * b, 2 * a * b),
                                      "The law of cosines gives the second angle:");
    const Expression s = steps.define("s", "2", branch(1 - c * c));
    steps.define_angle(two, atan2(factored(s), factored(c)));
    steps.define_angle(
        one,
        difference(atan2(factored(v), factored(u)), atan2(factored(b * s), factored(a + b * c))),
        "The first angle is the direction of the point minus its direction in link 1:");
    steps.remark(
        "There is a solution if @ is from -1 to 1; two, by the sign of @, with the elbow on either "
        "side.",
        {c, s});
  } else if (one.revolute) {
    const Expression a = one.length, cb = two.bend_cosine(), sb = two.bend_sine();
    if (sb.is_zero() && cb == Expression(1)) {
      const Expression r = steps.define("r", "", branch(u * u + v * v),
                                        "The distance of the point from joint 1, of either sign:");
      steps.define_slide(two, factored(r - a - two.length));
      steps.define_angle(one, atan2(over(v, r), over(u, r)));
      steps.remark("There are two solutions, by the sign of @; if it is 0, any angle is one.", {r});
      return;
    }
    const Expression w =
        steps.define("w", "", sum({factored(-(a * cb)), branch(u * u + v * v - a * a * sb * sb)}),
                     "The distance of the point from joint 1 is that in link 1, where the slide "
                     "is at w:");
    steps.define_slide(two, factored(w - two.length));
    steps.define_angle(one, difference(atan2(factored(v), factored(u)),
                                       atan2(factored(w * sb), factored(a + w * cb))));
    steps.remark("There is a solution if the root is real; two, by its sign.");
  } else {
    const auto [along, across] = steps.in_slide_axes(one, u, v);
    if (two.revolute) {
      const Expression s =
          steps.define("s", "2", over(across, two.length),
                       "The slide cannot move the point across, the rotation does:");
      const Expression c = steps.define("c", "2", branch(1 - s * s));
      steps.define_angle(two, atan2(factored(s), factored(c)));
      steps.define_slide(one, factored(along - one.length - two.length * c));
      steps.remark("There is a solution if @ is from -1 to 1; two, by the sign of @.", {s, c});
      return;
    }
    const Expression w =
        steps.define("w", "", over(across, two.bend_sine()),
                     "The first slide cannot move the point across, the second does:");
    steps.define_slide(two, factored(w - two.length));
    steps.define_slide(one, factored(along - one.length - w * two.bend_cosine()));
    steps.remark("There is one solution.");
  }
}

/// Solves for an arm whose last joint rotates: the other joints bring its axis to the point that
/// the orientation determines.
void solve_wrist(InverseSteps& steps, const std::vector<PlanarLink>& links) {
  Expression u = steps.x(), v = steps.y();
  if (!links[2].length.is_zero()) {
    u = steps.define("u", "", factored(steps.x() - links[2].length * steps.theta_cosine()),
                     "The last joint is at:");
    v = steps.define("v", "", factored(steps.y() - links[2].length * steps.theta_sine()));
  }
  solve_two(steps, links[0], links[1], u, v);
  steps.define_last_angle(links, 2, "The angles add up to the orientation:");
}

/// Solves for an arm whose last joint slides along the tool's x axis, which the orientation gives.
void solve_slide(InverseSteps& steps, const std::vector<PlanarLink>& links) {
  const PlanarLink &one = links[0], &two = links[1], &three = links[2];
  const Expression ct = steps.theta_cosine(), st = steps.theta_sine();
  if (one.revolute && two.revolute) {
    const auto [c, s] = steps.turned(three, -1);  // cosine and sine of the orientation of link 2
    const Expression u =
        steps.define("u", "", factored(steps.x() - two.length * c),
                     "Without link 2, whose orientation is known, the point is at:");
    const Expression v = steps.define("v", "", factored(steps.y() - two.length * s));
    const Expression sine =
        steps.define("s", "", over(v * ct - u * st, one.length),
                     "Across the slide it is moved by link 1 alone, at the angle "
                     "with sine s and cosine c to the tool:");
    const Expression cosine = steps.define("c", "", branch(1 - sine * sine));
    steps.define_angle(one,
                       atan2(factored(sine * ct + cosine * st), factored(cosine * ct - sine * st)));
    steps.define_last_angle(links, 1, "The angles add up to the orientation:");
    steps.define_slide(three, factored(u * ct + v * st - one.length * cosine - three.length));
    steps.remark("There is a solution if @ is from -1 to 1; two, by the sign of @.",
                 {sine, cosine});
  } else if (one.revolute) {
    steps.define_last_angle(links, 0, "The slides do not rotate the tool:");
    const auto [c2, s2] = std::pair(two.bend_cosine(), two.bend_sine());
    const auto [c1, s1] =
        steps.turned(three, -1);  // cosine and sine of the orientation before the second slide
    // The slides are along (c1, s1) and (ct, st), link 1 along the first turned back by bend 2.
    const Expression u =
        steps.define("u", "", factored(steps.x() - one.length * (c1 * c2 + s1 * s2)),
                     "Without link 1 the point is at:");
    const Expression v =
        steps.define("v", "", factored(steps.y() - one.length * (s1 * c2 - c1 * s2)));
    steps.define_slide(three,
                       difference(over(v * c1 - u * s1, three.bend_sine()), factored(three.length)),
                       "Its components along both slides are:");
    steps.define_slide(two,
                       difference(over(u * st - v * ct, three.bend_sine()), factored(two.length)));
    steps.remark("There is one solution.");
  } else {
    steps.define_last_angle(links, 1, "The slides do not rotate the tool:");
    const auto [c, s] = steps.turned(three, -1);  // cosine and sine of the orientation of link 2
    const Expression u = steps.define("u", "", factored(steps.x() - two.length * c),
                                      "Without link 2 the point is at:");
    const Expression v = steps.define("v", "", factored(steps.y() - two.length * s));
    const Expression cb = one.bend_cosine(), sb = one.bend_sine();
    steps.define_slide(three,
                       difference(over(v * cb - u * sb, st * cb - ct * sb), factored(three.length)),
                       "Its components along both slides are:");
    steps.define_slide(one,
                       difference(over(u * st - v * ct, st * cb - ct * sb), factored(one.length)));
    steps.remark("There is one solution unless the slides are parallel.");
  }
}

/// Returns the links of an arm that has a derivation; none for others.
std::vector<PlanarLink> links_with_derivation(const SymbolicArm& arm) {
  std::vector<PlanarLink> links = planar_links(arm);
  if (links.size() != 2 && links.size() != 3) return {};
  const auto rotates = [&](std::size_t i) { return links[i].revolute; };
  const auto slides = [&](std::size_t i) { return i < links.size() && !rotates(i); };
  if (slides(0) && slides(1) && slides(2)) return {};
  for (std::size_t i = 1; i < links.size(); ++i) {
    const bool parallel_slides = slides(i - 1) && slides(i) && links[i].bend_sine().is_zero();
    if (parallel_slides) return {};
  }
  // Without a length, the first link makes the axes of two rotations one, and the second leaves the
  // angle of its joint undetermined.
  if (rotates(0) && rotates(1) && links[0].length.is_zero()) return {};
  if (rotates(1) && !slides(2) && links[1].length.is_zero()) return {};
  return links;
}

}  // namespace

bool has_inverse_derivation(const SymbolicArm& arm) { return !links_with_derivation(arm).empty(); }

InverseDerivation planar_inverse(const SymbolicArm& arm) {
  const std::vector<PlanarLink> links = links_with_derivation(arm);
  if (links.empty()) {
    throw Error(
        "the inverse kinematics of arm " + arm.name +
        " is not derived in steps: that is for planar arms RR, RP, PR, PP, RRR, RPR, PRR, "
        "PPR, RRP, PRP and RPP of joint strings or DH tables, not mounted elsewhere, with a tool "
        "along the last link, links of a length and slides that are not parallel");
  }
  InverseSteps steps(arm, links.size() == 3);
  if (links.size() == 2) {
    solve_two(steps, links[0], links[1], steps.x(), steps.y());
  } else if (links[2].revolute) {
    solve_wrist(steps, links);
  } else {
    solve_slide(steps, links);
  }
  InverseDerivation derivation = steps.finish();
  check_derivation(arm, derivation);
  return derivation;
}

}  // namespace beeline::internal
