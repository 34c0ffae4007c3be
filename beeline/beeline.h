#pragma once

/// Includes all public headers of Beeline. A program links with the libraries that it calls.
/// beeline::core has poses, arms, kinematics, inverse kinematics, trajectories, paths, timing,
/// certificates, planning and control. beeline::batch computes many rows at once, beeline::reach
/// has reachability and manipulability maps, beeline::io reads and writes files, beeline::draw
/// draws pictures, beeline::formula derives symbolic formulas, and beeline::doctor diagnoses
/// models. beeline::beeline is all of them.

#include <beeline/batch/batch.h>
#include <beeline/budget.h>
#include <beeline/certificate/clearance.h>
#include <beeline/certificate/verify.h>
#include <beeline/collision/collision_model.h>
#include <beeline/collision/scene.h>
#include <beeline/control/cartesian.h>
#include <beeline/control/joint.h>
#include <beeline/control/player.h>
#include <beeline/control/replay.h>
#include <beeline/control/servo.h>
#include <beeline/control/tracker.h>
#include <beeline/doctor/comparison.h>
#include <beeline/doctor/diagnosis.h>
#include <beeline/draw/animation.h>
#include <beeline/draw/arm_figure.h>
#include <beeline/draw/drawing.h>
#include <beeline/draw/figure.h>
#include <beeline/draw/paper.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/error.h>
#include <beeline/formula/document.h>
#include <beeline/formula/expression.h>
#include <beeline/formula/formula.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/io/number_rows.h>
#include <beeline/io/program.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/json.h>
#include <beeline/io/text/numbers.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/io/text/scene.h>
#include <beeline/io/text/urdf.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/kinematics/task.h>
#include <beeline/model/arm.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/model/moving_base.h>
#include <beeline/path/blend.h>
#include <beeline/path/joint_path.h>
#include <beeline/path/segment.h>
#include <beeline/path/tool_path.h>
#include <beeline/planning/branch.h>
#include <beeline/planning/free_path.h>
#include <beeline/planning/move_along.h>
#include <beeline/planning/program.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>
#include <beeline/pose/so3.h>
#include <beeline/reach/grid.h>
#include <beeline/reach/place.h>
#include <beeline/reach/reach.h>
#include <beeline/reach/reach_map.h>
#include <beeline/reach/surface.h>
#include <beeline/reason.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/timing/retime.h>
#include <beeline/timing/time_scaling.h>
#include <beeline/trajectory/limit_usage.h>
#include <beeline/trajectory/trajectory.h>
