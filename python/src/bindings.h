#pragma once

#include <beeline/model/arm.h>

#include <nanobind/nanobind.h>

namespace beeline::python {

// Each adds its part of the module, in this order: later ones use the classes of earlier ones.
void bind_poses(nanobind::module_& module);
void bind_planar_poses(nanobind::module_& module);  ///< by bind_poses()
void bind_arms(nanobind::module_& module);
void bind_arm_files(nanobind::class_<Arm>& arm);  ///< by bind_arms(): the chain between two links
void bind_written_arms(nanobind::module_& m, nanobind::class_<Arm>& arm);  ///< by bind_arms()
void bind_screws(nanobind::class_<Arm>& arm);                              ///< by bind_arms()
void bind_moving_bases(nanobind::class_<Arm>& arm);                        ///< by bind_arms()
nanobind::object model_warning();  ///< the category of warnings of readers, ModelWarning
void bind_random_configurations(nanobind::module_& module);
void bind_kinematics(nanobind::module_& module);
void bind_derivatives(nanobind::module_& module);
void bind_tasks(nanobind::module_& module);
void bind_inverse(nanobind::module_& module);
void bind_trajectories(nanobind::module_& module);
void bind_paths(nanobind::module_& module);
void bind_joint_paths(nanobind::module_& module);
void bind_timing(nanobind::module_& module);
void bind_certificates(nanobind::module_& module);
void bind_collisions(nanobind::module_& module);
void bind_distances(nanobind::module_& module);
void bind_planning(nanobind::module_& module);
void bind_pose_lists(nanobind::module_& module);
void bind_programs(nanobind::module_& module);
void bind_clearances(nanobind::module_& module);
void bind_free_paths(nanobind::module_& module);
void bind_controller_files(nanobind::module_& module);
void bind_control(nanobind::module_& module);
void bind_pids(nanobind::module_& module);
void bind_servos(nanobind::module_& module);
void bind_players(nanobind::module_& module);
void bind_trackers(nanobind::module_& module);
void bind_formulas(nanobind::module_& module);
void bind_doctor(nanobind::module_& module);
void bind_reach(nanobind::module_& module);
void bind_pictures(nanobind::module_& module);
void bind_command_line(nanobind::module_& module);

}  // namespace beeline::python
