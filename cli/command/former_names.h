#pragma once

#include <string>

#include "verb.h"

/// Names of verbs and options, and the order of arguments, in version 0.1 and in other programs,
/// for errors that give the present ones.

/// "--profile" for "--law"; empty for an option that was not renamed.
std::string current_option_name(const std::string& name);

/// "retime" for "time"; empty for a verb that was not renamed.
std::string current_verb_name(const std::string& name);

/// The verb that does what other programs call by this name, such as `fk` for Robotics Toolbox's
/// fkine; empty if there is none.
std::string verb_of_other_programs(const std::string& name);

/// Throws Error if the arguments of a verb `VERB ARM FILE...` were given as `VERB FILE... ARM`.
void refuse_former_order(const Verb& verb);
