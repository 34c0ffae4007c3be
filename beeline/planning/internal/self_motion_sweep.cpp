#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/planning/internal/knot_sequence.h>
#include <beeline/planning/internal/self_motion_starts.h>
#include <beeline/planning/internal/self_motion_sweep.h>

namespace beeline::internal {
namespace {

using Node = RedundantConfiguration;

// The shortest step between layers as a fraction of the regular one: where no curve continues, and
// where one is lost.
constexpr double min_step = 1e-4, min_lost_step = 1.0 / 16;

Bounds without(const std::vector<bool>& cyclic, Bounds bounds) {
  for (std::size_t k = 0; k < cyclic.size(); ++k) {
    if (!cyclic[k]) continue;
    bounds.lower[static_cast<Eigen::Index>(k)] = -Limits::none;
    bounds.upper[static_cast<Eigen::Index>(k)] = Limits::none;
  }
  return bounds;
}

/// Returns the path parameter from which the tool moves after `s`: behind the segments at rest that
/// begin there.
double begin_of_motion(const ToolPath& path, const Task& task, double s) {
  auto i = static_cast<std::size_t>(s);
  if (s != static_cast<double>(i)) return s;
  while (i + 1 < path.segments.size() && stands_still(path.segments[i], task)) ++i;
  return static_cast<double>(i);
}

}  // namespace

SelfMotionLayer::SelfMotionLayer(double at, std::vector<SelfMotionCurve> of,
                                 const SelfMotion& motion, const GraphOptions& options,
                                 BudgetMeter& budget)
    : s(at), curves(std::move(of)) {
  for (const SelfMotionCurve& curve : curves) {
    first.push_back(margin.size());
    for (const Node& q : curve.nodes) {
      margin.push_back(motion.margin(q));
      clearance_margin.push_back(options.clearance_margin(Configuration(q), budget).value_or(-1));
    }
  }
  continuation.assign(margin.size(), {nowhere, 0});
}

const Node& SelfMotionLayer::node(std::size_t i) const {
  const auto c = std::upper_bound(first.begin(), first.end(), i) - first.begin() - 1;
  const auto curve = static_cast<std::size_t>(c);
  return curves[curve].nodes[i - first[curve]];
}

SelfMotionSweep::SelfMotionSweep(const Arm& arm, const ToolPath& path, const GraphOptions& options,
                                 const std::vector<bool>& cyclic, BudgetMeter& budget)
    : arm_(arm),
      path_(path),
      options_(options),
      motion_(arm, options.task, without(cyclic, bounds_of(arm)), cyclic, options.step),
      budget_(budget) {}

bool SelfMotionSweep::run() {
  add_first();
  if (layers_.empty()) return false;
  const std::vector<double> wanted = layer_parameters(arm_, path_, options_.task, options_.spacing);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    // Continues all layers of a segment at once. If a step is halved, the layers behind it move.
    const double begin = begin_of_motion(path_, options_.task, layers_.back().s);
    const double regular = wanted[k] - begin;
    const auto follows = [&](double s) {
      return segment_at(path_, s) == segment_at(path_, wanted[k]) &&
             std::abs(s - wanted[k] - regular) < 1e-9;
    };
    while (k + 1 < wanted.size() && follows(wanted[k + 1])) ++k;
    if (!add_layers(begin, wanted[k], regular)) return false;
    budget_.report(static_cast<double>(k + 1) / static_cast<double>(wanted.size()));
  }
  return true;
}

void SelfMotionSweep::add_first() {
  const Pose pose = pose_at(path_, 0);
  std::vector<SelfMotionCurve> curves;
  if (options_.start) {
    curves = {SelfMotionCurve{{Node(*options_.start)}}};
  } else {
    curves =
        curves_through(motion_, pose,
                       self_motion_starts(arm_, options_.task, pose, motion_, budget_), budget_)
            .curves;
  }
  if (!curves.empty()) layers_.emplace_back(0, std::move(curves), motion_, options_, budget_);
}

/// Adds layers from path parameter `s`, where the tool is at the pose of the last layer, up to
/// `end`, at this distance or, where that is too far, at less; returns whether they reach it.
bool SelfMotionSweep::add_layers(double s, double end, double regular) {
  double step = regular;
  while (s < end) {
    if (budget_.ended()) return false;
    const double left = end - s;
    const double next = left <= 1.0001 * step ? end : s + (left < 2 * step ? left / 2 : step);
    const Pose pose = pose_at(path_, next);
    const Continued continued = continued_to(pose);
    const bool none = continued.q.empty();
    const double shortest = regular * (none ? min_step : min_lost_step);
    if ((none || continued.lost) && next - s > shortest) {
      step = (next - s) / 2;
      continue;
    }
    if (none) return false;
    add(next, pose, continued);
    s = next;
    step = std::min(2 * step, regular);
  }
  return true;
}

/// The continuations of the last layer's nodes at a pose.
SelfMotionSweep::Continued SelfMotionSweep::continued_to(const Pose& pose) {
  Continued continued;
  for (std::size_t c = 0; c < layers_.back().curves.size() && !budget_.ended(); ++c) {
    continue_curve(pose, c, continued);
  }
  return continued;
}

void SelfMotionSweep::continue_curve(const Pose& pose, std::size_t c, Continued& continued) {
  constexpr double farthest = 0.5;  // of a joint; a larger move may lead to another branch
  const SelfMotionLayer& last = layers_.back();
  const std::vector<Node>& nodes = last.curves[c].nodes;
  const std::size_t before = continued.q.size();
  std::optional<Node> nearest;  // the node outside the limits that is nearest to them
  std::size_t nearest_node = 0;
  double largest = -Limits::none;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Node q = nodes[i];
    if (budget_.ended() || !motion_.solve(pose, q)) continue;
    if ((q - nodes[i]).lpNorm<Eigen::Infinity>() > farthest) continue;
    const double margin = motion_.margin(q);
    if (margin >= 0) {
      continued.q.push_back(q);
      continued.node.push_back(last.first[c] + i);
    } else if (margin > largest) {
      nearest = q;
      nearest_node = last.first[c] + i;
      largest = margin;
    }
  }
  if (continued.q.size() > before) return;
  if (!nearest) {
    continued.lost = true;
    return;
  }
  if (const auto q = motion_.move_inside(pose, *nearest, options_.step)) {
    continued.q.push_back(*q);
    continued.node.push_back(nearest_node);
  }
}

void SelfMotionSweep::add(double s, const Pose& pose, const Continued& continued) {
  SelfMotionCurves found = curves_through(motion_, pose, continued.q, budget_);
  for (std::size_t i = 0; i < found.places.size(); ++i) {
    layers_.back().continuation[continued.node[i]] = found.places[i];
  }
  layers_.emplace_back(s, std::move(found.curves), motion_, options_, budget_);
  budget_.ended(static_cast<std::int64_t>(layers_.back().size()));
}

}  // namespace beeline::internal
