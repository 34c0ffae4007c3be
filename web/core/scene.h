#pragma once

/// The C interface of an arm among obstacles, in the module of the command, together with memory.h.
/// Radians and metres. Files are in the module's file system.

extern "C" {

/// Returns the handle of the shapes of an arm's links, without obstacles. `arm` is an argument ARM
/// of the command line; `base` and `tip` are links of a URDF file, or empty. `clearance`: the
/// distance to keep, m; 0 for the default.
int beeline_scene(const char* arm, const char* base, const char* tip, double clearance);
/// Returns the bodies of the arm as JSON, or null: {"bodies": SCENE, "links": [LINK, ...]}. The
/// shapes of each body are posed in the frame of its link, of which `links` has the index. Valid
/// until the next call.
const char* beeline_scene_links(int scene);
/// Returns the distance to keep except from obstacles with their own, m.
double beeline_scene_clearance(int scene);
/// Reads a file of obstacles, as --scene takes it, and returns it as JSON
/// (docs/scene.schema.json), or null. Valid until the next call.
const char* beeline_scene_read(int scene, const char* path);
/// Replaces the obstacles by the ones of a JSON text. It is quick: what concerns the links alone
/// stays.
int beeline_scene_obstacles(int scene, const char* text);
/// Writes the pair with the least distance beyond its clearance at a configuration, of the pairs of
/// two links if `of_links` is 1, of the pairs with an obstacle if it is 0: the numbers of its two
/// bodies, which count the bodies of the arm before the obstacles; two bounds of its distance, the
/// clearance that it must keep, and the nearest points of both bodies in the world: 11 numbers.
/// Returns 0 if no such pair counts, else 1.
int beeline_scene_nearest(int scene, int of_links, const double* q, double* numbers);
/// Leads the arm among its obstacles from one configuration towards another, as far as the
/// clearance allows (guarded_motion.h); `slides`: 1 where the hand drags the tool, which slides
/// along the bodies, 0 where it drags a joint, which stops. Writes the configuration that is
/// reached, the numbers of the two bodies that hold the arm back, as above, -1 where none do, and 1
/// if the arm could stand at the goal, else 0: dof + 3 numbers. Returns 1 if the time ended while
/// the arm was on its way, else 0.
int beeline_scene_guard(int scene, int slides, const double* from, const double* to,
                        double* numbers);
int beeline_scene_release(int scene);
}
