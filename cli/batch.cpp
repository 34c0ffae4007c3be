#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <memory>

#include <beeline/error.h>
#include <beeline/io/number_rows.h>
#include <beeline/io/text/file.h>

#include "batch_work.h"
#include "blocked_solutions.h"
#include "command/progress.h"
#include "command/streams.h"
#include "format.h"
#include "json_reason.h"
#include "pose_argument.h"
#include "result_files.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct BatchReport {
  std::int64_t rows = 0;
  double seconds = 0;
  BatchCounts counts = {};
  BadRows bad = {};

  double rate() const { return seconds > 0 ? static_cast<double>(rows) / seconds : 0; }
};

/// Returns the number of rows in a block, for which input and output take a few megabytes.
Eigen::Index rows_in_a_block(const BatchWork& work) {
  constexpr std::size_t numbers = std::size_t{1} << 19;
  std::size_t width = work.columns.size();
  for (const auto& form : work.forms) width = std::max(width, form.size());
  return std::clamp<Eigen::Index>(static_cast<Eigen::Index>(numbers / width), 16, work.max_rows);
}

BatchReport process(const BatchArguments& arguments, const BatchWork& work) {
  const auto start = std::chrono::steady_clock::now();
  BatchReport report;
  report.bad.skip = arguments.skip_bad;
  RowReader reader(arguments.in, work.forms, work.units);
  if (!reader.has_header() && reader.form() >= work.forms_without_header) {
    throw FileError(reader.path(), 0,
                    fmt::format("rows of {} numbers without a header are not of --pose-form {}",
                                work.forms[reader.form()].size(), arguments.unit.pose_form));
  }
  RowWriter writer(arguments.out, work.columns, arguments.single, arguments.threads);
  RowBlock block;
  block.numbers.resize(static_cast<Eigen::Index>(work.forms[reader.form()].size()),
                       rows_in_a_block(work));
  Eigen::MatrixXd results;
  Progress progress;
  for (;;) {
    reader.read(block, report.bad);
    if (block.positions.empty()) break;
    work.step(reader.form(), block, results, report.counts, report.bad);
    if (report.counts.ending != Ending::complete) break;
    writer.write(results);
    report.rows += results.cols();
    if (const auto fraction = reader.fraction_read()) progress.show(*fraction);
  }
  // A .npy file states that its array has no rows; a .csv file without rows was cut off.
  const bool complete = report.counts.ending == Ending::complete;
  const bool nothing = complete && report.rows == 0 && report.bad.count == 0;
  if (nothing && extension(arguments.in) != "npy") {
    throw FileError(reader.path(), 0, "has a header but no rows below it");
  }
  if (complete) writer.commit();
  // Numbers that may be meant as several forms, or in several orders.
  if (!reader.has_header() && work.forms.size() > 1 && extension(arguments.in) != "npy") {
    warn_of_missing_header(reader.path(), work.forms[reader.form()]);
  }
  if (const auto units = reader.commented_units(); !units.empty()) {
    warn(sentence({.kind = PoseNoteKind::commented_unit, .columns = units}, reader.path()));
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

/// Warns of rows that were left out and of configurations outside the limits.
void warn_of_rows(const BatchArguments& arguments, const BatchReport& report) {
  const BatchCounts& counts = report.counts;
  if (report.bad.count > 0) {
    warn(fmt::format("{} left out; the first: {}", counted(report.bad.count, "bad row"),
                     report.bad.first));
  }
  if (counts.large_angle_row > 0) {
    warn_of_angle(fmt::format("--in {}, row {}", arguments.in, counts.large_angle_row),
                  counts.large_angle, counts.large_angle_form, arguments.unit);
  }
  warn_of_distance(fmt::format("--in {}, row {}", arguments.in, counts.far_row),
                   counts.far_distance, arguments.unit);
  if (counts.outside_limits > 0) {
    warn(fmt::format("{} outside the arm's limits; the first is row {}",
                     counted(counts.outside_limits, "row"), counts.first_outside));
  }
}

/// A line for each status of poses without a solution.
std::string statuses_text(const BatchCounts& counts) {
  std::string text;
  for (std::size_t i = 0; i < counts.statuses.size(); ++i) {
    const auto status = static_cast<InverseStatus>(i);
    if (counts.statuses[i] == 0 || status == InverseStatus::solved) continue;
    text += fmt::format("{:<13} {}\n", name(status), counts.statuses[i]);
  }
  return text;
}

std::string batch_text(const BatchArguments& arguments, const std::string& kind, const Arm& arm,
                       const BatchWork& work, const BatchReport& report) {
  std::string text = fmt::format("{} of {}: {} in {:.3g} s, {:.3g} rows/s\n", kind, arm.name(),
                                 counted(report.rows, "row"), report.seconds, report.rate());
  if (kind == "jacobian") {
    text += fmt::format("frame         {}\n", name(arguments.jacobian.read(arm).frame));
  }
  if (kind == "ik") text += fmt::format("solved        {}\n", report.counts.solved);
  if (kind == "ik" && arguments.status) text += statuses_text(report.counts);
  if (arguments.out != "-" && report.counts.ending == Ending::complete)
    text += fmt::format("rows          {}\n", arguments.out);
  if (work.scene) text += scene_text(*work.scene);
  return text;
}

/// {"solved": 3, "unreachable": 1}: the statuses that occur.
Json json_statuses(const BatchCounts& counts) {
  Json statuses = Json::object();
  for (std::size_t i = 0; i < counts.statuses.size(); ++i) {
    if (counts.statuses[i] == 0) continue;
    statuses.add(name(static_cast<InverseStatus>(i)), counts.statuses[i]);
  }
  return statuses;
}

Json batch_document(const BatchArguments& arguments, const std::string& kind, const Arm& arm,
                    const BatchWork& work, const BatchReport& report) {
  Json document{{"status", name(report.counts.ending)},
                {"arm", arm.name()},
                {"rows", report.rows},
                {"bad_rows", report.bad.count},
                {"seconds", report.seconds},
                {"rows_per_second", report.rate()}};
  if (kind == "ik") {
    document.add("solved", report.counts.solved);
    document.add("unsolved", report.rows - report.counts.solved);
    if (arguments.status) document.add("statuses", json_statuses(report.counts));
  } else {
    document.add("outside_limits", report.counts.outside_limits);
  }
  if (kind == "jacobian") {
    document.add("frame", name(arguments.jacobian.read(arm).frame));
  }
  if (work.scene) document.add("scene", scene_document(*work.scene));
  document.add("columns", work.columns);
  document.add("out", arguments.out);
  return document;
}

/// Why not all rows have a result; none if they have.
Reason reason_of(const BatchReport& report, bool inverse, bool rows_on_stdout) {
  const auto rows = static_cast<std::size_t>(report.rows);
  if (report.counts.ending != Ending::complete) {
    return {ReasonCode::ended_in_batch,
            {{ReasonField::ending, report.counts.ending},
             {ReasonField::count, rows},
             {ReasonField::without_file, !rows_on_stdout}}};
  }
  const auto solved = static_cast<std::size_t>(report.counts.solved);
  if (!inverse || solved == rows) return {};
  return {ReasonCode::poses_unsolved,
          {{ReasonField::count, rows - solved}, {ReasonField::of, rows}}};
}

using MakeWork = BatchWork (*)(const BatchArguments&, const Arm&);

Answer batch(const BatchArguments& arguments, const std::string& kind, MakeWork make_work) {
  row_format(arguments.out);
  std::vector<std::string> inputs = arguments.scene.inputs();
  inputs.push_back(arguments.in);
  refuse_overwriting(arguments.out, arguments.arm.inputs(inputs));
  const bool rows_on_stdout = arguments.out == "-";
  if (arguments.json && rows_on_stdout) {
    throw Error("--json cannot be combined with --out -: both would write to stdout");
  }
  const Arm arm = arguments.arm.read(arguments.unit);
  const BatchWork work = make_work(arguments, arm);
  const BatchReport report = process(arguments, work);
  warn_of_rows(arguments, report);
  const Reason reason = reason_of(report, kind == "ik", rows_on_stdout);
  Answer answer{.text = batch_text(arguments, kind, arm, work, report),
                .document = batch_document(arguments, kind, arm, work, report),
                .units = kind == "jacobian" ? Json{{"rows", jacobian_units}} : Json(),
                .yes = !reason,
                .reason = sentence(reason),
                .text_on_stderr = rows_on_stdout};
  answer.document.add(json_reason(reason));
  return answer;
}

constexpr const char* configurations_help =
    "Configurations, one in each row: .csv, with the joints' names in any order as header or "
    "without a header, or with units behind them, as joint1_deg; .npy of shape (N, joints), dtype "
    "'<f8' or '<f4'; or - for CSV on stdin.";
constexpr const char* poses_help =
    "Poses, one in each row, .csv, .npy or - for CSV on stdin: x,y,z,qw,qx,qy,qz; "
    "x,y,z,roll,pitch,yaw; x,y,z,rx,ry,rz; x,y,z,A,B,C; the matrix m11,m12,...,m44 row by row, "
    "16 numbers or the first 12; or x,y,theta (planar arms); with units behind the names or not, "
    "as x_mm. Without a header, as many numbers in this order; six numbers are in the form of "
    "--pose-form.";

/// The arguments and options that all verbs `batch NAME` have.
Verb common(const std::shared_ptr<BatchArguments>& shared, const char* name, const char* rows,
            const std::vector<Option>& own, MakeWork make_work) {
  BatchArguments& arguments = *shared;
  Verb verb{.name = name, .summary = ""};
  verb.arguments = {arguments.arm.argument()};
  verb.options = joined(
      {{Option("--in FILE", rows, &arguments.in, {.required = true}),
        Option("--out FILE",
               "The results, a row for each: .csv with a header, .npy, or - for CSV on stdout.",
               &arguments.out, {.required = true})},
       arguments.unit.options(),
       own,
       {threads_option(&arguments.threads),
        Option("--float", "Write 32-bit numbers to a .npy file.", &arguments.single),
        Option("--skip-bad",
               "Leave bad rows out and count them. By default a bad row ends the run with an error "
               "and no file is written.",
               &arguments.skip_bad)},
       {arguments.budget.time_limit_option()},
       arguments.arm.options()});
  verb.json = {shared, &arguments.json};
  verb.run = [shared, name, make_work] { return batch(*shared, name, make_work); };
  return verb;
}

Verb batch_fk() {
  const auto arguments = std::make_shared<BatchArguments>();
  const Option layout("--layout LAYOUT",
                      "matrix, the default without --pose-form: the 16 entries row by row; pose: "
                      "x,y,z,qw,qx,qy,qz with qw >= 0; planar: x,y,theta of a planar arm.",
                      &arguments->layout,
                      {.choices = {"matrix", "pose", "planar"}, .excludes = "--pose-form"});
  Verb verb = common(arguments, "fk", configurations_help, {layout}, forward_work);
  verb.summary = "Forward kinematics: the pose of the tool at each configuration";
  verb.examples = {
      {"Two configurations of the planar arm, in degrees",
       "printf 'joint1,joint2,joint3\\n0,90,0\\n112,-52,-60\\n' > q.csv\n"
       "beeline batch fk rrr --in q.csv --degrees --out poses.csv --layout pose"},
      {"Positions in millimetres and KUKA's A, B, C",
       "beeline batch fk rrr --in q.csv --degrees --out - --pose-form abc --millimetres"},
      {"The same as an array for numpy, from a pipe",
       "beeline batch fk rrr --in - --degrees --out poses.npy < q.csv"}};
  return verb;
}

Verb batch_jacobian() {
  const auto arguments = std::make_shared<BatchArguments>();
  Verb verb = common(arguments, "jacobian", configurations_help, arguments->jacobian.options(),
                     jacobian_work);
  verb.summary = "The Jacobian at each configuration";
  verb.description =
      "Writes one Jacobian in each row of the output, row by row: reshape it to (N, 6, joints). "
      "Entries are per radian, or per metre of a prismatic joint, also with --degrees.";
  verb.examples = {{"Two body Jacobians of the planar arm",
                    "printf '0,1.5,0\\n1,-1,0.5\\n' > q.csv\n"
                    "beeline batch jacobian rrr --in q.csv --out jacobians.npy --frame tool"}};
  return verb;
}

/// "0 solved, 1 unreachable, ...".
std::string numbered_statuses() {
  std::string text;
  int number = 0;
  for (const std::string& status : inverse_status_names()) {
    text += fmt::format("{}{} {}", number == 0 ? "" : ", ", number, status);
    ++number;
  }
  return text;
}

Verb batch_ik() {
  const auto arguments = std::make_shared<BatchArguments>();
  const Option status("--status",
                      "Add the columns status (" + numbered_statuses() +
                          ") and residual, m or rad, as in ik --json. Poses without a solution "
                          "then take longer.",
                      &arguments->status);
  Verb verb = common(arguments, "ik", poses_help,
                     joined({arguments->inverse.choice_options(),
                             arguments->inverse.search_options(),
                             arguments->scene.distance_options(),
                             {status}}),
                     inverse_work);
  verb.summary = "Inverse kinematics: a configuration for each pose";
  verb.description =
      "Writes the joint values of one solution in each row of the output, the first of beeline ik; "
      "nan if there is none; then the exit code is 1. With --scene or --self it is the first that "
      "keeps the clearance; a pose whose solutions all do not has the status blocked.";
  verb.examples = {{"Two poses of the planar arm, solutions in degrees",
                    "printf 'x,y,theta\\n4,3,0\\n4.5,5.2,30\\n' > poses.csv\n"
                    "beeline batch ik rrr --in poses.csv --degrees --out q.csv"},
                   {"Near a given configuration, written to stdout",
                    "beeline batch ik rrr --in poses.csv --degrees --seed 10,60,-30 --out -"}};
  return verb;
}

}  // namespace

Verb batch_verb() {
  Verb verb{.name = "batch", .summary = "fk, jacobian or ik of all rows of a file, .csv or .npy"};
  verb.description =
      "Computes one result for each row of a file and prints the number of rows and of rows per "
      "second. Rows are processed in blocks, so any number of them needs the same memory. The "
      "output file is complete or absent.";
  verb.examples = {{"Forward kinematics of two configurations",
                    "printf '0,90,0\\n112,-52,-60\\n' > q.csv\n"
                    "beeline batch fk rrr --in q.csv --degrees --out poses.csv"}};
  verb.verbs = {batch_fk(), batch_jacobian(), batch_ik()};
  return verb;
}

}  // namespace beeline::command
