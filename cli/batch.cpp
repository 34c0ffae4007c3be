#include <chrono>
#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/record/number_rows.h>

#include "batch_work.h"
#include "output.h"
#include "progress.h"
#include "results.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Report {
  std::int64_t rows = 0;
  double seconds = 0;
  BatchCounts counts;
  BadRows bad;

  double rate() const { return seconds > 0 ? static_cast<double>(rows) / seconds : 0; }
};

/// Rows at a time, so that what is read and what is written take a few megabytes.
Eigen::Index rows_at_a_time(const BatchWork& work) {
  constexpr std::size_t numbers = std::size_t{1} << 19;
  std::size_t width = work.columns.size();
  for (const auto& form : work.forms) width = std::max(width, form.size());
  return std::clamp<Eigen::Index>(static_cast<Eigen::Index>(numbers / width), 16, work.max_rows);
}

Report work_through(const BatchArguments& arguments, const BatchWork& work) {
  const auto start = std::chrono::steady_clock::now();
  Report report;
  report.bad.skip = arguments.skip_bad;
  RowReader reader(arguments.in, work.forms);
  RowWriter writer(arguments.out, work.columns, arguments.single, arguments.threads);
  RowBlock block;
  block.numbers.resize(static_cast<Eigen::Index>(work.forms[reader.form()].size()),
                       rows_at_a_time(work));
  Eigen::MatrixXd results;
  Progress progress;
  for (;;) {
    reader.read(block, report.bad);
    if (block.places.empty()) break;
    work.step(reader.form(), block, results, report.counts, report.bad);
    writer.write(results);
    report.rows += results.cols();
    const InputFile& file = reader.file();
    if (file.size() && *file.size() > 0) {
      progress.show(static_cast<double>(file.position()) / static_cast<double>(*file.size()));
    }
  }
  // A .npy file says that its array has no rows; a table without any has lost them.
  const bool nothing = report.rows == 0 && report.bad.count == 0;
  if (nothing && row_format(arguments.in) == RowFormat::csv) {
    throw FileError(reader.file().path(), 0, "has a header but no rows below it");
  }
  writer.put_in_place();
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

const char* plural(std::int64_t count) { return count == 1 ? "" : "s"; }

/// On stderr: what was left out, and what is outside limits.
void warn(const Report& report) {
  const BatchCounts& counts = report.counts;
  if (report.bad.count > 0) {
    fmt::print(stderr, "beeline: warning: {} bad row{} left out; the first: {}\n", report.bad.count,
               plural(report.bad.count), report.bad.first);
  }
  if (counts.outside_limits > 0) {
    fmt::print(stderr, "beeline: warning: {} row{} outside the arm's limits; the first is row {}\n",
               counts.outside_limits, plural(counts.outside_limits), counts.first_outside);
  }
}

void print_report(const BatchArguments& arguments, const std::string& kind, const Arm& arm,
                  const Report& report) {
  const bool spoken_for = arguments.out == "-";  // stdout has the rows
  std::FILE* const stream = spoken_for ? stderr : stdout;
  fmt::print(stream, "{} of {}: {} row{} in {:.3g} s, {:.3g} rows/s\n", kind, arm.name(),
             report.rows, plural(report.rows), report.seconds, report.rate());
  if (kind == "jacobian") fmt::print(stream, "frame         {}\n", arguments.frame);
  if (kind == "ik") fmt::print(stream, "solved        {}\n", report.counts.solved);
  if (!spoken_for) fmt::print("rows          {}\n", arguments.out);
}

OrderedJson document(const BatchArguments& arguments, const std::string& kind, const Arm& arm,
                     const BatchWork& work, const Report& report) {
  OrderedJson document{{"arm", arm.name()},
                       {"rows", report.rows},
                       {"bad_rows", report.bad.count},
                       {"seconds", report.seconds},
                       {"rows_per_second", report.rate()}};
  if (kind == "ik") {
    document["solved"] = report.counts.solved;
    document["unsolved"] = report.rows - report.counts.solved;
  } else {
    document["outside_limits"] = report.counts.outside_limits;
  }
  if (kind == "jacobian") document["frame"] = arguments.frame;
  document["columns"] = work.columns;
  document["out"] = arguments.out;
  return document;
}

using MakeWork = BatchWork (*)(const BatchArguments&, const Arm&);

Exit batch(const BatchArguments& arguments, const std::string& kind, MakeWork make_work) {
  row_format(arguments.in);
  row_format(arguments.out);
  refuse_overwriting(arguments.out, {arguments.in, arguments.arm.text});
  if (arguments.json && arguments.out == "-") {
    throw Error("--json does not go with --out -: both would write to stdout");
  }
  const Arm arm = arguments.arm.read();
  const BatchWork work = make_work(arguments, arm);
  const Report report = work_through(arguments, work);
  warn(report);
  if (arguments.json) {
    print_json(document(arguments, kind, arm, work, report));
  } else {
    print_report(arguments, kind, arm, report);
  }
  const std::int64_t unsolved = report.rows - report.counts.solved;
  if (kind != "ik" || unsolved == 0) return Exit::yes;
  fmt::print(stderr, "beeline: {} of {} poses without a solution: their rows are nan\n", unsolved,
             report.rows);
  return Exit::no;
}

void declare_common(CLI::App& verb, BatchArguments& arguments, const char* rows) {
  arguments.arm.declare(verb);
  verb.add_option("--in", arguments.in, rows)->required();
  verb.add_option("--out", arguments.out,
                  "Where the results go, a row for each: .csv with a header, .npy, or - for stdout")
      ->required();
  arguments.unit.declare(verb);
}

void declare_running(CLI::App& verb, BatchArguments& arguments) {
  verb.add_option("--threads", arguments.threads,
                  "0: as many as the machine has; the results are the same for any number")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  verb.add_flag("--float", arguments.single, "32-bit numbers in a .npy file");
  verb.add_flag("--skip-bad", arguments.skip_bad,
                "Leave bad rows out and count them; else the first ends the run, and nothing is\n"
                "written");
  verb.add_flag("--json", arguments.json, "Print JSON");
}

constexpr const char* configurations =
    "Configurations, one in a row: .csv, its header the joints' names in any order or none;\n"
    ".npy of shape (N, joints), '<f8' or '<f4'; or - for CSV from stdin";

void declare_forward(CLI::App& verb, BatchArguments& arguments) {
  declare_common(verb, arguments, configurations);
  verb.add_option("--layout", arguments.layout,
                  "matrix: 16 numbers, row by row; pose: x,y,z,qw,qx,qy,qz with qw >= 0")
      ->capture_default_str();
  declare_running(verb, arguments);
  verb.footer(
      "Examples:\n"
      "  beeline batch fk panda --in q.npy --out poses.npy\n"
      "  beeline batch fk rrr --in q.csv --degrees --out poses.csv --layout pose");
}

void declare_jacobian_rows(CLI::App& verb, BatchArguments& arguments) {
  declare_common(verb, arguments, configurations);
  verb.add_option("--frame", arguments.frame, "base, tool or space")->capture_default_str();
  arguments.task.declare(verb);
  declare_running(verb, arguments);
  verb.footer(
      "Each row has a Jacobian, row by row: reshape (N, 6, joints). Entries are per radian, or "
      "per\n"
      "metre of a joint that slides, also with --degrees.\n"
      "Example:\n"
      "  beeline batch jacobian panda --in q.npy --out jacobians.npy --frame tool");
}

void declare_inverse(CLI::App& verb, BatchArguments& arguments) {
  declare_common(verb, arguments,
                 "Poses, one in a row, .csv, .npy or - for CSV from stdin: x,y,z,qw,qx,qy,qz,\n"
                 "x,y,z,roll,pitch,yaw, the matrix m11,m12,...,m44 row by row, or x,y,theta\n"
                 "(planar arms); without a header, as many numbers in this order");
  arguments.inverse.declare_choices(verb);
  arguments.inverse.declare_search(verb);
  declare_running(verb, arguments);
  verb.footer(
      "Each row has the joint values of one solution, nan where there is none; then the exit code\n"
      "is 1.\n"
      "Examples:\n"
      "  beeline batch ik ur5 --in poses.npy --out q.npy\n"
      "  beeline batch ik panda --in poses.csv --out q.csv --seed 0,-0.8,0,-2.4,0,1.6,0.8");
}

}  // namespace

Run declare_batch(CLI::App& verb) {
  struct Kind {
    const char* name;
    const char* summary;
    void (*declare)(CLI::App&, BatchArguments&);
    MakeWork make_work;
    BatchArguments arguments;
    CLI::App* app = nullptr;
  };
  static Kind kinds[] = {
      {"fk", "The tool's pose at each configuration", declare_forward, forward_work, {}},
      {"jacobian", "The Jacobian at each configuration", declare_jacobian_rows, jacobian_work, {}},
      {"ik", "A configuration for each pose", declare_inverse, inverse_work, {}},
  };
  verb.require_subcommand(1);
  for (Kind& kind : kinds) {
    kind.app = verb.add_subcommand(kind.name, kind.summary);
    kind.declare(*kind.app, kind.arguments);
  }
  verb.footer(
      "Rows go through in blocks: any number of them needs the same memory. The file --out is\n"
      "there when all is done, or not at all.\n"
      "Examples:\n"
      "  beeline batch fk panda --in q.npy --out poses.npy\n"
      "  beeline batch jacobian ur5 --in q.csv --out jacobians.npy\n"
      "  beeline batch ik ur5 --in poses.csv --out q.csv --skip-bad");
  return [] {
    for (const Kind& kind : kinds) {
      if (kind.app->parsed()) return batch(kind.arguments, kind.name, kind.make_work);
    }
    return Exit::usage;
  };
}
