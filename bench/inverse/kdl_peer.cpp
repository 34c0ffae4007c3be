#include "kdl_peer.h"

#include <beeline/error.h>

#include "kdl_chain.h"
#include "poses.h"

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>

namespace beeline::bench {
namespace {

Eigen::Matrix<double, 6, 1> even_weights() { return Eigen::Matrix<double, 6, 1>::Ones(); }

}  // namespace

struct KdlPeer::Solver {
  KDL::Chain chain;
  KDL::ChainIkSolverPos_LMA lma;  // keeps a reference to the chain
  KDL::JntArray seed, answer;

  // KDL's default weights make the orientation a hundred times less accurate.
  explicit Solver(const Screws& arm)
      : chain(kdl_chain(arm)),
        lma(chain, even_weights(), 1e-6),
        seed(static_cast<unsigned>(arm.joints)),
        answer(static_cast<unsigned>(arm.joints)) {}
};

bool KdlPeer::installed() { return true; }

KdlPeer::KdlPeer(const Screws& screws) : solver_(std::make_unique<Solver>(screws)) {
  KDL::ChainFkSolverPos_recursive fk(solver_->chain);
  Engine engine(1);
  for (int n = 0; n < 100; ++n) {
    const Configuration q = random_configuration(screws, engine);
    solver_->seed.data = q;
    KDL::Frame tool;
    fk.JntToCart(solver_->seed, tool);
    if (!(miss(forward(screws, q), pose_of(tool)) < 1e-12)) {
      throw Error("KDL's forward kinematics differs from the benchmark's own");
    }
  }
}

KdlPeer::~KdlPeer() = default;

bool KdlPeer::solve(const Pose& world_T_tool, const Configuration& seed, Configuration& q) {
  solver_->seed.data = seed;
  const bool arrived =
      solver_->lma.CartToJnt(solver_->seed, frame_of(world_T_tool), solver_->answer) == 0;
  q = solver_->answer.data;
  return arrived;
}

}  // namespace beeline::bench
