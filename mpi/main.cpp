// beeline-reach-mpi map ARM --out FILE ...: `beeline reach map` by all ranks of an MPI job, on as
// many machines as it has. Each slab is written whole to FILE.parts. A killed rank ends the job;
// the same command then continues, with any number of ranks.

#include <beeline/error.h>
#include <beeline/reach/reach_map.h>

#include "cli/command/program.h"
#include "cli/command/progress.h"
#include "cli/command/streams.h"
#include "cli/reach_map.h"
#include "cli/reach_totals.h"
#include "cli/verbs.h"
#include "dispatcher.h"

#include <fcntl.h>
#include <mpi.h>
#include <unistd.h>

using namespace beeline;
using namespace beeline::command;

namespace {

int rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

/// All ranks find the same mistakes in the options; rank 0 reports them.
class QuietRanks {
 public:
  QuietRanks() : stderr_(dup(STDERR_FILENO)) {
    if (rank() == 0) return;
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
  void end() const { dup2(stderr_, STDERR_FILENO); }

 private:
  int stderr_;
};

/// The exit codes of the command (cli/command/program.cpp).
constexpr int mistake = 2, file_trouble = 3;

void abort_job(const std::string& reason, int code) {
  print_error(reason);
  MPI_Abort(MPI_COMM_WORLD, code);
}

/// Rank 0 distributes the units, computes units itself, and joins the results of all ranks.
Answer lead(ReachMapUnits& units, const ReachMapJob& job) {
  Ending ending = Ending::complete;
  {
    Progress progress;
    Dispatcher dispatcher(units.missing());
    try {
      // A rank whose budget has ended still requests units until none is left for the dispatcher.
      ending = units.compute([&] {
        progress.show(dispatcher.fraction());
        return dispatcher.next();
      });
    } catch (const FileError& error) {  // the dispatcher would wait for all other ranks
      abort_job(error.what(), file_trouble);
    }
  }
  ending = static_cast<Ending>(largest_of_all(static_cast<int>(ending)));
  if (ending != Ending::complete) return interrupted_map(job.out, ending);
  units.join();
  return computed_map(job);
}

Answer compute(const MakeReachMapJob& make_job) {
  const ReachMapJob job = make_job();
  if (job.options.shard.count != 1) {
    throw Error("--shard is for `beeline reach map`: the ranks divide the map among them");
  }
  if (rank() != 0) largest_of_all(0);  // after rank 0 has made the folder
  ReachMapUnits units(job.arm, job.grid, job.out, job.options.reach);
  if (rank() == 0) {
    largest_of_all(0);
    return lead(units, job);
  }
  largest_of_all(static_cast<int>(units.compute(ask_for_unit)));
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  int threads = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &threads);
  const QuietRanks quiet;
  const Verb verb = reach_map_verb([&quiet, threads](const MakeReachMapJob& make_job) {
    quiet.end();
    try {
      if (threads < MPI_THREAD_MULTIPLE) throw Error("this MPI does not allow several threads");
      return compute(make_job);
    } catch (const FileError& error) {
      abort_job(error.what(), file_trouble);
    } catch (const std::exception& error) {
      abort_job(error.what(), mistake);
    }
    return Answer{};
  });
  const int code = run_program({verb}, argc, argv);
  MPI_Finalize();
  return code;
}
