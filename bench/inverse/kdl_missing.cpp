#include <beeline/error.h>

#include "kdl_peer.h"

namespace beeline::bench {

struct KdlPeer::Solver {};

bool KdlPeer::installed() { return false; }
KdlPeer::KdlPeer(const Screws&) { throw Error("KDL is not installed: liborocos-kdl-dev"); }
KdlPeer::~KdlPeer() = default;
bool KdlPeer::solve(const Pose&, const Configuration&, Configuration&) { return false; }

}  // namespace beeline::bench
