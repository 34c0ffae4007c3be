#pragma once

#include <beeline/io/trajectory_file.h>

#include "signature.h"
#include "trajectory_fields.h"

namespace beeline::python {

/// The keywords joint_map and unit, and their place in a signature.
MatchOptions matching(const Arm& arm, nb::handle joint_map, nb::handle angle_unit, nb::handle unit);
void takes_matching(Signature& signature);

void bind_loading(nb::class_<Trajectory>& trajectory);
void bind_recordings(nb::module_& m);

template <>
struct Fields<RecordingNote>
    : Members<&RecordingNote::kind, &RecordingNote::path, &RecordingNote::columns,
              &RecordingNote::time_unit, &RecordingNote::finer_unit, &RecordingNote::joint_unit,
              &RecordingNote::comment, &RecordingNote::joint, &RecordingNote::value> {};

template <>
struct Fields<Recording>
    : Members<&Recording::trajectory, &Recording::has_times, &Recording::mapped,
              &Recording::in_time_unit, &Recording::notes> {};

}  // namespace beeline::python
