#pragma once

#include <string_view>

namespace beeline::internal {

/// What a word may say that a unit belongs to, as bits.
enum Subject : unsigned {
  any_subject = 1,      ///< units, values
  joint_subject = 2,    ///< joints
  time_subject = 4,     ///< times
  angle_subject = 8,    ///< angles
  length_subject = 16,  ///< lengths
  position_subject = 32,
  velocity_subject = 64,
  acceleration_subject = 128,
  other_subject = 256,   ///< a quantity that no column has, or that is not read
  single_subject = 512,  ///< one of several joints: the first, the others
};

/// The part that a word or a mark of a comment plays in a statement about units.
enum class WordKind {
  unit,           ///< of all_units(), also per second: `deg/s`, `degrees per second`
  all_si,         ///< SI
  unread_unit,    ///< foreign_unit(), also per second or in another rate: `deg/min`
  other_unit,     ///< of a quantity that is not read: Nm
  number,         ///< digits
  column,         ///< the name of a column
  subject,        ///< Subject
  link,           ///< between a subject and its unit: `in`, `:`, `(`
  separator,      ///< between subjects or units: `,`, `and`
  filler,         ///< of no effect
  negation,       ///< not, no
  before_former,  ///< makes the unit behind it a former or another one: `from`, `to`, `was`
  doubt,          ///< makes any statement unclear: converted, instead, or
  truth,          ///< the value of a setting: true, off
  end,            ///< of a clause
  unknown,
};

/// The part of a word that has the same one in every comment.
struct Meaning {
  WordKind kind = WordKind::unknown;
  unsigned subject = 0;  ///< of Subject
};

/// Returns the meaning of a word in lower case or of a mark. In a table of `poses`, words such as
/// `orientation` and `tool` are of its columns and `joints` is an other_subject; in other tables it
/// is the reverse.
Meaning meaning_of(std::string_view word, bool poses);

}  // namespace beeline::internal
