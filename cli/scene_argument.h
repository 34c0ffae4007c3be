#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/certificate/clearance.h>
#include <beeline/io/text/json.h>
#include <beeline/planning/branch.h>
#include <beeline/planning/program.h>

#include "arm_argument.h"

namespace beeline::command {

/// A shape that is the convex hull of a mesh.
struct MeshHull {
  std::string body = {};     ///< name of the link or obstacle
  std::string mesh = {};     ///< path of the mesh
  std::size_t vertices = 0;  ///< of the hull
  double padding = 0;        ///< distance by which the hull is grown, m
};

/// An arm with its shapes among obstacles, as the options of SceneArgument give it, and the facts
/// about it that reports list.
struct CheckedScene {
  CollisionModel model;
  std::vector<std::string> links = {}, obstacles = {};  ///< names of the bodies
  double clearance = 0;                                 ///< by --clearance, m
  bool self_collision = true;                           ///< false: --no-self
  bool obstacles_have_clearances = false;      ///< whether an obstacle has a clearance of its own
  std::vector<NamedPair> allowed_pairs = {};   ///< by --allow and the scenes
  std::string srdf = {};                       ///< the file of --srdf; empty: none
  std::vector<NamedPair> srdf_pairs = {};      ///< pairs that this file exempts
  std::vector<NamedPair> exempted_pairs = {};  ///< pairs of bodies that a scene's matrix exempts
  std::map<std::string, double> held = {};     ///< see ArmShapes::held
  std::map<std::string, std::string> held_by_state = {};  ///< see ArmShapes::held_by_state
  /// See Scene::held, by the path of the scene.
  std::map<std::string, std::map<std::string, double>> scenes_held = {};
  std::vector<MeshHull> mesh_hulls = {};
  std::vector<std::string> links_without_shapes = {};  ///< of the arm: they are not checked
  /// See Scene::links_without_shapes, by the path of the scene.
  std::map<std::string, std::vector<std::string>> scenes_without_shapes = {};

  /// Whether no pair of bodies counts.
  bool checks_nothing() const { return model.pair_count() + model.apart_count() == 0; }
};

/// The arm has no shapes of its links.
struct NoShapesError : Error {
  using Error::Error;
};

/// Warns if no pair of bodies counts, so that nothing is checked.
void warn_if_unchecked(const CheckedScene& scene);

/// A line of a report: `label`, such as "may touch", and its text.
struct SceneLine {
  std::string label, text;
};

/// Returns the exemptions and assumptions of answers about a scene: pairs that may touch, held
/// joints, meshes and links without shapes.
std::vector<SceneLine> conditions(const CheckedScene& scene);
/// The same in JSON, with the names of the bodies.
Json conditions_document(const CheckedScene& scene);
/// Returns the number of bodies: "4 links and 3 obstacles".
std::string number_of_bodies(const CheckedScene& scene);
/// Returns what the reason against a configuration adds: the options that exempt the pairs that are
/// too close there.
std::string exemption_clause(const CheckedScene& scene, const ConfigurationRef& q);
/// Returns the lines as they stand in a report.
std::string lines_text(const std::vector<SceneLine>& lines);

/// A program that a motion follows, in a file, with the sample at which each move ends.
struct FollowedProgram {
  const Program& program;
  std::string file = {};
  std::vector<std::size_t> arrivals = {};
};

/// Whether a motion keeps its clearance.
struct ClearanceReport {
  const CheckedScene* scene = nullptr;
  double clearance = 0;  ///< distance to keep, m, except from obstacles with their own
  ClearanceProof proof = {};
  Configuration q = {};                   ///< of a motion that is refused, at the time of `proof`
  std::string picture = {};               ///< the file that shows it, see draw_refusal()
  std::vector<NamedPair> too_close = {};  ///< at the time of a collision, at most 100
  std::string start_clause = {};          ///< see SceneArgument::start_clause()
  std::vector<Attachment> attachments = {};  ///< of the program; the times and poses of each:
  std::vector<AttachedPart> attached = {};

  /// Whether no pair of bodies counts, so that the proof says nothing.
  bool checks_nothing() const;
  /// Returns what is proved: "each of the 12 pairs that count keeps at least 0.05 m".
  std::string guarantee() const;
  /// Returns when the clearance is kept: "at all times", or "from 0.04 s on" after a recovery.
  std::string when() const;
  /// Returns the beginning that leads out of the clearance, if there is one.
  std::vector<SceneLine> recovery() const;
  /// Returns the parts that are attached, and the conditions() of the scene.
  std::vector<SceneLine> conditions() const;
  /// Returns the status of a motion that is refused.
  MotionStatus refusal() const;
  /// Adds how the search for another motion ended, if the motion's reason has that.
  void add_search_ending(const Reason& of_motion);
  /// Returns the sentence of the reason, with the option that exempts the pairs.
  std::string reason_text() const;
  std::string text() const;
  Json document() const;
};

/// --scene, --radius, --self, --no-self, --clearance, --allow, --hold, --package, --tool-shape and
/// --resolution: a motion is proved to keep its clearance. With --recover-clearance it may
/// start closer.
struct SceneArgument {
  std::vector<std::string> scenes = {}, allow = {}, hold = {}, package = {};
  std::string tool_shape = {};
  bool self = false, no_self = false;
  std::optional<double> clearance, resolution, radius, recover_clearance;
  /// False where mounts are searched: no obstacle is then given in a frame that moves with them.
  bool fixed_mount = true;

  std::vector<Option> options();
  /// The same without --resolution and --recover-clearance, for single configurations.
  std::vector<Option> distance_options();
  /// --scene, --tool-shape, --hold and --package, which say what the bodies are.
  std::vector<Option> body_options();
  bool given() const { return self || !scenes.empty(); }
  /// The files that are read, for refuse_overwriting().
  std::vector<std::string> inputs() const;

  /// Reads the scenes and the shapes of the arm; returns nothing without --scene and --self. Warns
  /// of links without shapes. Throws Error for an option without them, for an arm without shapes,
  /// and for names that are not known.
  std::optional<CheckedScene> read(const ArmArgument& arm_argument, const Arm& arm) const;

  /// Returns what the reason of a refused motion adds if it starts closer than the clearance: the
  /// deepest pair, its depth and the value of --recover-clearance that accepts it. Empty if it does
  /// not start there.
  /// `accepted`: the clause for a start that the option accepts.
  std::string start_clause(const CheckedScene& scene, const Configuration& start,
                           std::string_view accepted) const;

  /// Proves or refutes that the motion keeps its clearance.
  ClearanceReport prove(const CheckedScene& scene, const Trajectory& motion,
                        const Budget& budget) const;
  /// The same for a motion whose refusal may be because of this start, see start_clause(); nothing
  /// if the motion cannot take --recover-clearance.
  ClearanceReport prove_from(const std::optional<Configuration>& start, const CheckedScene& scene,
                             const Trajectory& motion, const Budget& budget) const;
  /// The same for the motion of a program, with the parts that it attaches. Throws FileError for
  /// its rows.
  ClearanceReport prove(const CheckedScene& scene, const Trajectory& motion,
                        const FollowedProgram& followed, const Budget& budget) const;

 private:
  std::vector<Option> obstacle_options();
  std::vector<Option> shape_options();
  ClearanceOptions proof_options(const Budget& budget) const;
  /// What start_clause() adds to the refusal of a motion because of its start.
  std::string clause_of_refusal(const CheckedScene& scene, const Configuration& start,
                                const ClearanceProof& proof) const;
  /// Throws Error for an option that needs --scene or --self.
  void refuse_without_scene() const;
  ShapeOptions reading_options() const;
  ArmShapes shapes_of(const ArmArgument& arm_argument, const Arm& arm,
                      const ShapeOptions& options) const;
};

}  // namespace beeline::command
