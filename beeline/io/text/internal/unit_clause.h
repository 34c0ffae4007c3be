#pragma once

#include <span>
#include <vector>

#include <beeline/io/text/internal/comment_words.h>

namespace beeline::internal {

/// What a unit in a comment belongs to.
struct UnitClaim {
  const Unit* unit = nullptr;  ///< null: one in which no numbers are read
  std::string text;            ///< the unit as the comment has it
  int power = 0;               ///< of 1 / s
  bool times = false;          ///< it is one of times
  int order = -1;              ///< of the derivative, if the comment says it or the unit does
  std::vector<std::size_t> columns = {};  ///< empty: all of the quantity
};

/// Units that occur, as Quantity.
struct QuantitySet {
  bool angles = false, lengths = false, times = false;

  bool any() const { return angles || lengths || times; }
};

/// The units in a clause of a comment.
struct UnitClause {
  std::vector<UnitClaim> claims = {};
  QuantitySet unclear = {};  ///< quantities about which the clause is not clear
};

UnitClause unit_clause(std::span<const CommentWord> words);

}  // namespace beeline::internal
