#include "work_frame.h"

namespace beeline::command {
namespace {

/// Whether a task with these three rows is the same in axes that are rotated, by about z only if
/// `upright`.
bool rows_are_kept(bool x, bool y, bool z, bool upright) { return x == y && (upright || x == z); }

bool is_kept(const Task& task, const Pose& world_T_work) {
  constexpr double tilt = 1e-12;
  if (task.frame == Frame::tool) return true;
  const bool upright = (world_T_work.linear().col(2) - Vector3::UnitZ()).norm() <= tilt;
  const auto& rows = task.rows;
  return rows_are_kept(rows[0], rows[1], rows[2], upright) &&
         rows_are_kept(rows[3], rows[4], rows[5], upright);
}

}  // namespace

WorkFrame::WorkFrame(const Arm& world_arm, const Task& task, const WorkArgument& work,
                     const UnitArgument& unit)
    : arm(world_arm) {
  if (work.text.empty()) return;
  const Pose world_T_work = work.read(world_arm, unit).pose;
  const bool kept = is_kept(task, world_T_work);
  positions = kept ? PositionFrame::work : PositionFrame::world;
  if (!kept) return;
  frame_T_world = world_T_work.inverse();
  arm = with_mount(world_arm, frame_T_world);
}

std::vector<Pose> WorkFrame::seen(std::vector<Pose> poses) const {
  for (Pose& pose : poses) pose = frame_T_world * pose;
  return poses;
}

Program WorkFrame::seen(Program program) const {
  for (Move& move : program.moves) {
    move.target = frame_T_world * move.target;
    if (move.via) move.via = frame_T_world * *move.via;
  }
  return program;
}

}  // namespace beeline::command
