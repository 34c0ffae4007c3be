#include "peers.h"

#include <beeline/error.h>

#include "../inverse/poses.h"

namespace beeline::bench {

std::vector<std::unique_ptr<KinematicsPeer>> kinematics_peers(const Screws& screws) {
  std::vector<std::unique_ptr<KinematicsPeer>> peers;
#ifdef BEELINE_BENCH_KDL
  peers.push_back(kdl_kinematics(screws));
#endif
#ifdef BEELINE_BENCH_PINOCCHIO
  peers.push_back(pinocchio_kinematics(screws));
#endif
  Engine engine(1);
  for (const auto& peer : peers) {
    for (int n = 0; n < 100; ++n) {
      const Configuration q = random_configuration(screws, engine);
      if (!(miss(forward(screws, q), peer->forward(q)) < 1e-12)) {
        throw Error(std::string(peer->name()) +
                    "'s forward kinematics differs from the benchmark's own");
      }
    }
  }
  return peers;
}

}  // namespace beeline::bench
