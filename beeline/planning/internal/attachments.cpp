#include <algorithm>
#include <limits>

#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/planning/internal/attachments.h>
#include <beeline/planning/internal/program_parts.h>

namespace beeline {
namespace internal {
namespace {

/// The number of moves before the end; more than there are if it stays attached.
std::size_t end_of(const Attachment& attachment) {
  return attachment.until.value_or(std::numeric_limits<std::size_t>::max());
}

/// Throws Error unless the arm rests at the waypoint after this many moves.
void check_rest(const Program& program, std::size_t moves, const char* what) {
  if (moves == 0 || !is_passed(program, moves - 1)) return;
  throw Error("the tool passes " + move_name(program, moves - 1) + " without a stop; " + what +
              " needs one: give the move no blend, or a dwell that ends a spline");
}

/// Whether one part is attached twice at a time. One may begin where the other ends.
bool overlap(const Attachment& a, const Attachment& b) {
  return a.part == b.part && a.after < end_of(b) && b.after < end_of(a);
}

void check_attachment(const Program& program, std::size_t i) {
  const Attachment& attachment = program.attachments[i];
  if (attachment.part.empty()) throw Error("a part has no name");
  const std::size_t count = program.moves.size();
  for (const std::size_t moves : {attachment.after, attachment.until.value_or(0)}) {
    if (moves <= count) continue;
    throw Error("the program has " + std::to_string(count) + " moves, not " +
                std::to_string(moves));
  }
  if (end_of(attachment) <= attachment.after) {
    throw Error("the part is detached before a move carries it");
  }
  check_rest(program, attachment.after, "attaching a part");
  if (attachment.until) check_rest(program, *attachment.until, "detaching a part");
  for (std::size_t k = 0; k < i; ++k) {
    if (!overlap(program.attachments[k], attachment)) continue;
    throw Error("the part is attached already, by " + attachment_name(program, k));
  }
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void check_in_scene(const Attachment& attachment, const CollisionBodies& bodies) {
  std::vector<std::string> obstacles, names;
  const Obstacle* part = nullptr;
  for (const LinkShapes& link : bodies.links) names.push_back(link.name);
  for (const Obstacle& obstacle : bodies.scene.obstacles) {
    obstacles.push_back(obstacle.name);
    names.push_back(obstacle.name);
    if (obstacle.name == attachment.part) part = &obstacle;
  }
  if (obstacles.empty()) throw Error("the scene has no obstacle that could be attached");
  if (part == nullptr) throw unknown_name("obstacle", attachment.part, obstacles);
  if (part->cloud) throw Error("a part with a point cloud cannot be carried");
  for (const Shape& shape : part->shapes) {
    if (std::holds_alternative<HalfSpace>(shape.body)) {
      throw Error("a part with a half_space cannot be carried");
    }
  }
  if (part->clearance.value_or(0) > bodies.options.clearance) {
    throw Error("the obstacle has a clearance of its own, " + number(*part->clearance) +
                " m, larger than the clearance of all bodies, " + number(bodies.options.clearance) +
                " m, which a carried part keeps");
  }
  for (const std::string& name : attachment.touch) {
    if (!is_among(names, name)) throw unknown_name("link or obstacle", name, names);
    if (name == attachment.part) throw Error("the part itself is among the bodies it may touch");
  }
}

/// Whether the arm is within tolerance of a move's waypoint from one sample to another.
bool stays(const WaypointRests& rests, const Move& move, std::size_t a, std::size_t b) {
  for (std::size_t k = std::min(a, b); k <= std::max(a, b); ++k) {
    if (rests.offset(move, k) > 1) return false;
  }
  return true;
}

/// Returns a sample at which the arm rests at a move's waypoint, apart from the arrivals at it and
/// at the waypoints before and after it, which are at `before` and `after`.
std::optional<std::size_t> other_rest(const WaypointRests& rests, const Move& move,
                                      std::size_t before, std::size_t arrival, std::size_t after) {
  for (const std::size_t k : rests.rests(move, before)) {
    const auto is_apart = [&](std::size_t from) { return !stays(rests, move, k, from); };
    if (k < after && is_apart(before) && is_apart(arrival) && is_apart(after)) return k;
  }
  return std::nullopt;
}

template <class Check>
void for_each_attachment(const Program& program, const Check& check) {
  for (std::size_t i = 0; i < program.attachments.size(); ++i) {
    try {
      check(i);
    } catch (const Error& error) {
      throw AttachmentError(program, i, error.what());
    }
  }
}

}  // namespace

void check_attachments(const Program& program) {
  if (program.attachments.size() > max_moves) {
    throw Error("the program has " + std::to_string(program.attachments.size()) +
                " attachments; at most " + std::to_string(max_moves) + " are accepted");
  }
  for_each_attachment(program, [&](std::size_t i) { check_attachment(program, i); });
}

void check_attachments(const Program& program, const CollisionModel& model) {
  check_attachments(program);
  for_each_attachment(
      program, [&](std::size_t i) { check_in_scene(program.attachments[i], model.bodies()); });
}

void check_attachments(const Program& program, const Trajectory& trajectory,
                       const WaypointRests& rests, const std::vector<std::size_t>& arrivals) {
  const auto check = [&](std::size_t moves) {
    if (moves == 0) return;
    const std::size_t before = moves == 1 ? 0 : arrivals[moves - 2], at = arrivals[moves - 1];
    const std::size_t after = moves < arrivals.size() ? arrivals[moves] : trajectory.size() - 1;
    const auto other = other_rest(rests, program.moves[moves - 1], before, at, after);
    if (!other) return;
    throw Error(
        "the arm rests at the waypoint of " + move_name(program, moves - 1) + " at " +
        number(trajectory.times[std::min(at, *other)]) + " s and again at " +
        number(trajectory.times[std::max(at, *other)]) +
        " s, and which of them is meant is not known; a waypoint between them determines it");
  };
  for_each_attachment(program, [&](std::size_t i) {
    check(program.attachments[i].after);
    check(program.attachments[i].until.value_or(0));
  });
}

}  // namespace internal

std::string attachment_name(const Program& program, std::size_t i) {
  const Attachment& attachment = program.attachments.at(i);
  return "attach " + attachment.part +
         (attachment.place.empty() ? "" : " (" + attachment.place + ")");
}

AttachmentError::AttachmentError(const Program& program, std::size_t attachment,
                                 const std::string& fault)
    : Error(attachment_name(program, attachment) + ": " + fault),
      attachment_(attachment),
      fault_(fault) {}

}  // namespace beeline
