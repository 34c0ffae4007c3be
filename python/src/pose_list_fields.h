#pragma once

#include <beeline/io/text/pose_list.h>

#include "record.h"

namespace beeline::python {

template <>
struct Fields<PoseFormat> : Members<&PoseFormat::angle_unit, &PoseFormat::triple,
                                    &PoseFormat::pose_form, &PoseFormat::millimetres> {};

template <>
struct Fields<PoseList>
    : Members<&PoseList::poses, &PoseList::lines, &PoseList::planar, &PoseList::max_angle,
              &PoseList::oriented, &PoseList::columns, &PoseList::has_header, &PoseList::form,
              &PoseList::vector_in_degrees, &PoseList::commented_units> {};

}  // namespace beeline::python
