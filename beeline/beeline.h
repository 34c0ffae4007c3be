#pragma once

/// Includes all public headers of Beeline. A program links with what it calls: beeline::core has
/// poses, arms, kinematics, inverse kinematics, trajectories, paths, timing, certificates, planning
/// and control; beeline::read the readers and writers of files, beeline::batch many rows at once,
/// beeline::draw pictures, beeline::formula
/// formulas in symbols; beeline::beeline is all of them.

#include <beeline/batch/batch.h>
#include <beeline/budget.h>
#include <beeline/certificate/joint_faults.h>
#include <beeline/certificate/path_deviation.h>
#include <beeline/certificate/verify.h>
#include <beeline/control/cartesian.h>
#include <beeline/control/controlled_motion.h>
#include <beeline/control/joint.h>
#include <beeline/control/pid.h>
#include <beeline/control/player.h>
#include <beeline/control/replay.h>
#include <beeline/control/servo.h>
#include <beeline/control/tracker.h>
#include <beeline/draw/animation.h>
#include <beeline/draw/arm_figure.h>
#include <beeline/draw/canvas.h>
#include <beeline/draw/chapter.h>
#include <beeline/draw/figure.h>
#include <beeline/draw/paper.h>
#include <beeline/draw/scene.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/error.h>
#include <beeline/formula/code.h>
#include <beeline/formula/document.h>
#include <beeline/formula/expression.h>
#include <beeline/formula/formula.h>
#include <beeline/formula/symbolic_arm.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/analytical_jacobian.h>
#include <beeline/kinematics/derivatives.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/kinematics/task.h>
#include <beeline/model/arm.h>
#include <beeline/model/catalog.h>
#include <beeline/model/chain.h>
#include <beeline/model/composite.h>
#include <beeline/model/dh.h>
#include <beeline/model/joint.h>
#include <beeline/path/blend.h>
#include <beeline/path/joint_path.h>
#include <beeline/path/segment.h>
#include <beeline/path/tool_path.h>
#include <beeline/planning/branch.h>
#include <beeline/planning/move_along.h>
#include <beeline/planning/nearby_path.h>
#include <beeline/planning/program.h>
#include <beeline/planning/status.h>
#include <beeline/pose/angle.h>
#include <beeline/pose/orientation.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>
#include <beeline/pose/so3.h>
#include <beeline/read/arm.h>
#include <beeline/read/arm_json.h>
#include <beeline/read/joint_limits.h>
#include <beeline/read/joint_string.h>
#include <beeline/read/pose_list.h>
#include <beeline/read/urdf.h>
#include <beeline/record/number_rows.h>
#include <beeline/record/trajectory_file.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/timing/profile.h>
#include <beeline/timing/retime.h>
#include <beeline/timing/s_curve.h>
#include <beeline/timing/time_scaling.h>
#include <beeline/trajectory/difference.h>
#include <beeline/trajectory/limit_usage.h>
#include <beeline/trajectory/trajectory.h>
