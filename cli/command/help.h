#pragma once

#include <string>
#include <vector>

#include "verb.h"

namespace beeline::command {

/// The help of one verb: usage, description, arguments, options, examples. `command` is what was
/// typed, such as "beeline batch fk".
std::string help_text(const Verb& verb, const std::string& command);

/// The help of the whole command: the verbs, and what all of them share.
std::string overview(const std::vector<Verb>& verbs);

/// What `beeline` without a verb prints: what it is, three examples, and where the help is.
std::string short_help();

/// What all verbs share, in paragraphs: arms, units, output, exit codes.
const std::string& conventions();

/// The help of an option with its default and the options that it requires, in sentences.
std::string full_help(const Option& option);

/// "--kp, --gain K", and "-h, --help".
std::string heading(const Option& option);

/// `beeline help VERB`. `verbs` must outlive the verb.
Verb help_verb(const std::vector<Verb>& verbs);

}  // namespace beeline::command
