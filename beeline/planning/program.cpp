#include <beeline/certificate/internal/clearance_recovery.h>
#include <beeline/certificate/internal/printed_bound.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/internal/enum_names.h>
#include <beeline/planning/internal/attachments.h>
#include <beeline/planning/internal/printed_motion.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/program_planner.h>
#include <beeline/planning/program.h>
#include <beeline/trajectory/internal/recovery.h>

namespace beeline {

using namespace internal;

namespace {

constexpr internal::EnumNames<MoveKind> move_kinds("motion");
constexpr internal::EnumNames<BlendOutcome> blend_outcomes("blend");

/// Whether the links and limits of two arms are the same; their bases may be at different poses.
bool is_same(const Arm& a, const Arm& b) {
  if (!same_joints(a, b)) return false;
  for (int k = 0; k < a.dof(); ++k) {
    const Limits &x = a.limits(k), &y = b.limits(k);
    if (x.lower != y.lower || x.upper != y.upper || x.velocity != y.velocity ||
        x.acceleration != y.acceleration || x.jerk != y.jerk) {
      return false;
    }
  }
  return true;
}

/// Throws Error for a model of another arm, and for parts and moves that its scene does not have.
void check_scene(const Arm& arm, const Program& program, const CollisionModel* model) {
  if (model != nullptr) {
    if (!is_same(model->arm(), arm)) {
      throw Error("", "model", " has an arm with other links or limits, " + model->arm().name());
    }
    return check_attachments(program, *model);
  }
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    if (program.moves[i].kind != MoveKind::around) continue;
    throw MoveError(program, i, "a motion around obstacles needs their scene");
  }
}

}  // namespace

std::string name(MoveKind value) { return move_kinds.of(value); }

MoveKind move_kind_named(std::string_view name) { return move_kinds.named(name); }

std::string name(BlendOutcome value) { return blend_outcomes.of(value); }

bool is_joint_motion(MoveKind kind) { return kind == MoveKind::joint || kind == MoveKind::around; }

std::string move_name(const Program& program, std::size_t i) {
  const Move& move = program.moves.at(i);
  return "move " + std::to_string(i + 1) + " (" + name(move.kind) +
         (move.place.empty() ? "" : ", " + move.place) + ")";
}

std::ostream& operator<<(std::ostream& out, const ProgramMotion& motion) {
  print_motion(out, motion);
  if (!motion) return out;
  out << ", " << motion.moves.size() << (motion.moves.size() == 1 ? " move, " : " moves, ");
  print_assumed(print_bound(out, motion.deviation.bound), motion.limits);
  if (motion.search_ending == Ending::complete) return out;
  return out << "; blends: " << internal::ended_reason(ReasonCode::ended, motion.search_ending);
}

MoveError::MoveError(const Program& program, std::size_t move, const std::string& fault)
    : Error(move_name(program, move) + ": " + fault), move_(move), fault_(fault) {}

ProgramMotion move_program(const Arm& arm, const std::optional<Configuration>& start,
                           const Program& program, const PathMotionOptions& options,
                           const CollisionModel* model) {
  check_program(arm, program, options.task);
  check_recover(options.recover);
  check_recover_clearance(options.recover_clearance);
  if (options.recover_clearance > 0 && (!start || model == nullptr)) {
    throw Error("", "recover_clearance", " needs a start and a model");
  }
  check_scene(arm, program, model);
  if (options.duration) throw Error("duration is for paths; the moves of a program have speeds");
  if (options.blocked_by.reason || options.blocked_by.spare_clearance)
    throw Error("blocked_by is for paths; a program has one motion");
  return planned_program(arm, start, program, options, model);
}

}  // namespace beeline
