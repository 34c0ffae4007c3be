#pragma once

#include <string>

#include <beeline/reach/reach.h>
#include <beeline/reach/reach_map.h>

/// What `reach map` is to compute.
struct ReachMapJob {
  beeline::Arm arm;
  beeline::ReachGrid grid;
  std::string out;
  beeline::ReachMapOptions options = {};
};

/// The job of the options that were typed. Throws Error as ReachGrid does.
ReachMapJob reach_map_job();
