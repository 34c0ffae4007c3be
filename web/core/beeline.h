#pragma once

/// The C interface of core.wasm, together with memory.h. Radians, metres, seconds.

extern "C" {

/// Returns the handle of an arm, 0 or more. Without a text, `name` is a built-in arm or a joint
/// string with lengths, as the command line's ARM; with one, it is the name of a file with that
/// text, .urdf or .json. `base` and `tip` are links of a URDF file, or empty.
int beeline_arm(const char* name, const char* text, const char* base, const char* tip);
/// Returns the arm as JSON, as `beeline show --out` writes it, or null. Valid until the next call.
const char* beeline_arm_json(int arm);
/// Returns what `beeline show --json` prints without units, or null. Valid until the next call.
const char* beeline_arm_description(int arm);
/// Returns the names of the built-in arms as a JSON list. Valid until the next call.
const char* beeline_built_in_names();
/// Releases an arm; its handle is not valid any more. An unknown handle fails.
int beeline_arm_release(int arm);
/// Returns the number of coordinates.
int beeline_arm_dof(int arm);
/// Returns the number of links, the base included.
int beeline_arm_links(int arm);
/// Returns whether the arm is planar, 0 or 1.
int beeline_arm_planar(int arm);

/// Writes the poses in the world of all links and, last, of the tool: column-major 4 x 4 matrices,
/// links + 1 of them.
int beeline_forward(int arm, const double* q, double* matrices);

/// Writes the arm's centre line in the world, 6 + 13 numbers for each joint: the base's position;
/// of each joint the kind (0 revolute, 1 prismatic, 2 helical), the direction of its axis, where
/// the line meets the axis and where it leaves it, and the position of its symbol; the tool's
/// position. Returns the number of joints.
int beeline_skeleton(int arm, const double* q, double* numbers);
/// Writes a configuration that shows the arm well, far from singularities.
int beeline_display_configuration(int arm, double* q);

/// Writes the 6 x dof Jacobian, column-major, rows [vx vy vz wx wy wz]. `frame` is 0 base, 1 tool,
/// 2 space.
int beeline_jacobian(int arm, const double* q, int frame, double* columns);

/// Writes the measures of the task's rows (the default task of the arm): the manipulability, the
/// condition number, and min(rows, dof) singular values, at most 8 numbers. Returns the number of
/// singular values.
int beeline_manipulability(int arm, const double* q, double* measures);

/// Writes the solutions nearest to `seed`, nearest first, dof numbers each, and returns their
/// number: at most `capacity`, which is 1 or more; above 1, all are computed. 0 if there is none:
/// `beeline ik` says why. `pose` is the column-major 4 x 4 matrix of the tool in the world.
/// `ignore_limits` is 0 or 1.
int beeline_inverse(int arm, const double* pose, const double* seed, int ignore_limits,
                    int capacity, double* solutions);

/// Returns the handle of a PID controller in joint space for `dof` coordinates that begins at q.
int beeline_pid(int dof, double kp, double ki, double kd, const double* q, const double* goal);
/// Adds one step to q.
int beeline_pid_step(int pid, double* q);
int beeline_pid_release(int pid);

/// Returns the handle of a trajectory read from the text of a file, .csv or .json, its columns in
/// the order of the arm's joints.
int beeline_trajectory(int arm, const char* name, const char* text);
/// Returns the number of samples.
int beeline_trajectory_size(int trajectory);
/// Returns 1 for positions alone, 2 with velocities, 3 with accelerations too.
int beeline_trajectory_columns(int trajectory);
/// Writes of each sample the time, the positions, and the velocities and accelerations where the
/// file has them.
int beeline_trajectory_values(int trajectory, double* numbers);
/// Writes the joint values at a time of the motion that the columns mean.
int beeline_trajectory_sample(int trajectory, double time, double* q);
/// Returns the content of a file with this name, .csv or .json, or null. Valid until the next call.
const char* beeline_trajectory_text(int trajectory, const char* name);
int beeline_trajectory_release(int trajectory);
}
