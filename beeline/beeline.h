#pragma once

/// All public headers of the library `beeline::core`: poses, arms, kinematics, inverse kinematics,
/// trajectories, paths, timing, certificates, planning, control. The other libraries have their own
/// headers: <beeline/batch/batch.h> (beeline::batch), <beeline/read/...> and <beeline/record/...>
/// (beeline::read), and <beeline/draw/...> (beeline::draw).

#include <beeline/certificate/joint_faults.h>
#include <beeline/certificate/path_deviation.h>
#include <beeline/certificate/verify.h>
#include <beeline/control/cartesian.h>
#include <beeline/control/joint.h>
#include <beeline/control/pid.h>
#include <beeline/control/player.h>
#include <beeline/control/replay.h>
#include <beeline/control/servo.h>
#include <beeline/control/simulate.h>
#include <beeline/error.h>
#include <beeline/inverse/inverse_kinematics.h>
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
#include <beeline/planning/status.h>
#include <beeline/pose/angle.h>
#include <beeline/pose/orientation.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>
#include <beeline/pose/so3.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/timing/profile.h>
#include <beeline/timing/retime.h>
#include <beeline/timing/s_curve.h>
#include <beeline/timing/time_scaling.h>
#include <beeline/trajectory/difference.h>
#include <beeline/trajectory/limit_usage.h>
#include <beeline/trajectory/trajectory.h>
