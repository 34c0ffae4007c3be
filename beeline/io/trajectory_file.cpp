#include <algorithm>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/io/internal/controller_form.h>
#include <beeline/io/internal/controller_guarantees.h>
#include <beeline/io/internal/controller_moves.h>
#include <beeline/io/internal/controller_program.h>
#include <beeline/io/internal/joint_states.h>
#include <beeline/io/internal/program_frames.h>
#include <beeline/io/internal/setpoints.h>
#include <beeline/io/internal/trajectory_csv.h>
#include <beeline/io/internal/trajectory_json.h>
#include <beeline/io/internal/trajectory_yaml.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/trajectory_file.h>

namespace beeline {
namespace {

constexpr internal::EnumNames<ControllerForm> form_names("form of a controller");

const internal::FormDescription& description(ControllerForm form) {
  const auto& forms = internal::controller_forms();
  return *std::find_if(forms.begin(), forms.end(),
                       [form](const auto& candidate) { return candidate.form == form; });
}

/// Only ASCII: the controllers' editors take files in various encodings.
std::string comment(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

/// Adds the comments on what is proved for a file.
void add_guarantees(const ControllerFile& file, std::vector<std::string>& comments) {
  comments.push_back(comment("Guarantees that hold for this file: " + file.proof));
  for (const std::string& text : file.not_proved)
    comments.push_back(comment("Not proved: " + text));
  if (!file.note.empty()) comments.push_back(comment("Note: " + file.note));
}

/// A further comment of the file. ROS and tables of numbers are UTF-8.
std::string remark(const internal::FormDescription& form, std::string text) {
  if (form.six_axes) return comment(std::move(text));
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  }
  return text;
}

std::string with_comments(const std::vector<std::string>& comments, const std::string& text) {
  std::string result;
  for (const std::string& line : comments) result += "# " + line + '\n';
  return result + text;
}

std::string text_in_form(ControllerForm form, const Trajectory& samples,
                         const std::vector<std::string>& comments,
                         const ControllerFileOptions& options,
                         const internal::ProgramFrames& frames) {
  const internal::ProgramSource source{samples, comments, options.program_name, frames};
  switch (form) {
    case ControllerForm::ros2:
      return with_comments(comments, internal::trajectory_to_json(samples));
    case ControllerForm::urscript:
      return internal::urscript_program(source, 1 / options.rate.value_or(default_urscript_rate));
    case ControllerForm::rapid:
      return internal::rapid_program(source);
    case ControllerForm::krl:
      return internal::krl_program(source);
    case ControllerForm::csv:
      return with_comments(comments, internal::trajectory_to_csv(samples));
  }
  return "";
}

}  // namespace

TrajectoryFormat trajectory_format(const std::string& path) {
  const std::string ending = extension(path);
  if (ending == "csv") return TrajectoryFormat::csv;
  if (ending == "json") return TrajectoryFormat::json;
  if (ending == "yaml" || ending == "yml") return TrajectoryFormat::yaml;
  throw Error("trajectories are .csv, .json or .yaml files, not " + internal::in_quotes(path));
}

TrajectoryFormat trajectory_format(const std::string& path, std::string_view text) {
  const std::string ending = extension(path);
  const auto table = [&] {
    const bool yaml =
        internal::begins_with_joint_state(text) || internal::begins_with_trajectory(text);
    return yaml ? TrajectoryFormat::yaml : TrajectoryFormat::csv;
  };
  if (ending.empty()) {
    return internal::first_character(text) == '{' ? TrajectoryFormat::json : table();
  }
  for (const char* const other : {"txt", "tsv", "dat", "log"}) {
    if (ending == other) return table();
  }
  try {
    return trajectory_format(path);
  } catch (const Error&) {
    throw FileError(path, 0,
                    "is not a known kind of trajectory file; known are .csv, .json, .yaml and, "
                    "read as .csv, .txt, .tsv, .dat, .log");
  }
}

std::string trajectory_text(const Trajectory& trajectory, TrajectoryFormat format) {
  switch (format) {
    case TrajectoryFormat::csv:
      return internal::trajectory_to_csv(trajectory);
    case TrajectoryFormat::json:
    case TrajectoryFormat::yaml:  // JSON is YAML
      return internal::trajectory_to_json(trajectory);
  }
  return "";
}

void write_trajectory(const std::string& path, const Trajectory& trajectory) {
  write_file(path, trajectory_text(trajectory, trajectory_format(path)));
}

std::string name(ControllerForm form) { return form_names.of(form); }

std::vector<std::string> controller_form_names() { return form_names.all(); }

ControllerForm controller_form_named(const std::string& name) { return form_names.named(name); }

std::vector<std::string> controller_file_endings(ControllerForm form) {
  return description(form).endings;
}

void check_controller_form(const Arm& arm, ControllerForm form) {
  internal::check_arm_in(description(form), arm);
}

void check_controller_form(const Arm& arm, const Program& program, ControllerForm form) {
  if (!description(form).six_axes) {
    throw Error(name(form) + " files hold trajectories; plan the program first and export that");
  }
  check_controller_form(arm, form);
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    const MoveKind kind = program.moves[i].kind;
    const bool spline = kind == MoveKind::spline && form != ControllerForm::krl;
    if (kind != MoveKind::screw && !spline) continue;
    throw MoveError(program, i,
                    name(form) + " has no " + name(kind) + " moves" + (spline ? "; krl has" : "") +
                        "; export the planned trajectory instead");
  }
}

ControllerFile controller_file(const Arm& arm, const Trajectory& trajectory, ControllerForm form,
                               const ControllerFileOptions& options) {
  const internal::FormDescription& described = description(form);
  internal::check_arm_in(described, arm);
  internal::check_rate_in(described, options.rate);
  if (options.work) throw Error("a work frame is for the export of programs, not of trajectories");
  Trajectory samples = matched_to(arm, trajectory);
  if (samples.size() == 0) throw Error("the trajectory has no samples");
  std::optional<double> rate = options.rate;
  if (form == ControllerForm::urscript && !rate) rate = default_urscript_rate;
  samples = rate ? internal::setpoints(samples, *rate) : internal::from_time_zero(samples);
  if (form == ControllerForm::csv) {
    samples.velocities.clear();
    samples.accelerations.clear();
  }
  const internal::ControllerGuarantees known =
      internal::guarantees_of(arm, trajectory, samples, form, rate.has_value(), options);
  ControllerFile file;
  file.reason = known.refusal;
  file.proof = known.proof;
  file.not_proved = known.not_proved;
  const internal::ProgramFrames frames = internal::program_frames(arm, std::nullopt);
  file.note = (described.six_axes ? internal::note_on_tool(frames) : "") +
              internal::note_on_form(described, samples);
  file.samples = samples.size();
  file.duration = samples.times.back();
  std::vector<std::string> comments;
  if (options.comments) {
    comments = {std::string(internal::own_comment) + std::to_string(file.samples) + " samples in " +
                number(file.duration) + " s"};
    add_guarantees(file, comments);
    for (const std::string& text : options.remarks) comments.push_back(remark(described, text));
  }
  const std::string text = text_in_form(form, samples, comments, options, frames);
  if (file) file.text = text;
  return file;
}

ControllerFile controller_file(const Arm& arm, const Program& program, const ProgramMotion& motion,
                               ControllerForm form, const ControllerFileOptions& options) {
  const internal::FormDescription& described = description(form);
  check_controller_form(arm, program, form);
  if (options.rate) throw Error("a rate is for the export of trajectories, not of programs");
  if (!motion || motion.moves.size() != program.moves.size()) {
    throw Error("only a program that is planned completely is exported");
  }
  ControllerFile file;
  file.proof = "the order and the waypoints";
  file.not_proved = {
      "times, limits, deviations and the arm's branch: the controller plans each motion between "
      "the waypoints again, with its own profiles and blends"};
  const internal::ProgramFrames frames = internal::program_frames(arm, options.work);
  file.note =
      internal::note_on_frames(form, frames) + internal::note_on_form(described, motion.trajectory);
  file.samples = program.moves.size();
  file.duration = motion.trajectory.times.back();
  std::vector<std::string> comments{
      std::string(internal::own_comment) + std::to_string(file.samples) +
      " moves, planned and certified with " + number(file.duration) +
      " s and a deviation of at most " + deviation_text(motion.deviation.bound)};
  add_guarantees(file, comments);
  for (const std::string& text : options.remarks) comments.push_back(remark(described, text));
  const internal::MoveSource source{
      motion.trajectory.positions.front(),
      internal::controller_moves(arm, program, motion, frames.frame_of_poses()), comments,
      options.program_name, frames};
  file.text = form == ControllerForm::urscript ? internal::urscript_moves(source)
              : form == ControllerForm::rapid  ? internal::rapid_moves(source)
                                               : internal::krl_moves(source);
  return file;
}

}  // namespace beeline
