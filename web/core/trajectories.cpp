#include <algorithm>

#include <beeline/io/trajectory_file.h>
#include <beeline/trajectory/trajectory.h>

#include "arms.h"
#include "beeline.h"
#include "fault.h"
#include "handles.h"

using namespace beeline;
using web::guarded;

namespace {

web::Handles<Trajectory>& trajectories() {
  static web::Handles<Trajectory> handles("trajectory");
  return handles;
}

}  // namespace

int beeline_trajectory(int arm, const char* name, const char* text) {
  return guarded([&] {
    return trajectories().add(matched_to(web::arm_of(arm), parse_trajectory(text, name)));
  });
}

int beeline_trajectory_size(int trajectory) {
  return guarded([&] { return static_cast<int>(trajectories().at(trajectory).size()); });
}

int beeline_trajectory_columns(int trajectory) {
  return guarded([&] {
    const Trajectory& motion = trajectories().at(trajectory);
    return 1 + static_cast<int>(!motion.velocities.empty()) +
           static_cast<int>(!motion.accelerations.empty());
  });
}

int beeline_trajectory_values(int trajectory, double* numbers) {
  return guarded([&] {
    const Trajectory& motion = trajectories().at(trajectory);
    for (std::size_t k = 0; k < motion.size(); ++k) {
      *numbers++ = motion.times[k];
      for (const auto* rows : {&motion.positions, &motion.velocities, &motion.accelerations}) {
        if (!rows->empty()) numbers = std::copy((*rows)[k].begin(), (*rows)[k].end(), numbers);
      }
    }
    return 0;
  });
}

int beeline_trajectory_sample(int trajectory, double time, double* q) {
  return guarded([&] {
    const TrajectoryState state = sample(trajectories().at(trajectory), time);
    std::copy(state.position.begin(), state.position.end(), q);
    return 0;
  });
}

const char* beeline_trajectory_text(int trajectory, const char* name) {
  return web::text(
      [&] { return trajectory_text(trajectories().at(trajectory), trajectory_format(name)); });
}

int beeline_trajectory_release(int trajectory) {
  return guarded([&] { return trajectories().release(trajectory), 0; });
}
