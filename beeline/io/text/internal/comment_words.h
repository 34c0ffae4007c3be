#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/text/internal/comment_meaning.h>
#include <beeline/io/text/internal/foreign_unit.h>

namespace beeline::internal {

struct CommentWord {
  WordKind kind = WordKind::unknown;
  std::string text = {};  ///< in lower case
  const Unit* unit = nullptr;
  const ForeignUnit* foreign = nullptr;  ///< null for `deg/min`
  int power = 0;                         ///< of 1 / s in a unit
  unsigned subject = 0;
  std::size_t column = 0;
  bool has_times = false;  ///< the column
};

/// The names of a table's columns, for the words of its comments.
class ColumnWords {
 public:
  explicit ColumnWords(const std::vector<std::string>& columns);

  /// Returns the words of a comment. A name of a column is one word where a unit follows it,
  /// between other names and marks, and a single_subject where another subject follows. A table
  /// with columns x and y, or a matrix, has poses: meaning_of().
  std::vector<CommentWord> words_of(std::string_view comment) const;

 private:
  /// By letters and digits in lower case, `joint1` of `Joint 1`; none: of several columns.
  std::unordered_map<std::string, std::optional<std::size_t>> columns_;
  std::vector<bool> has_times_;  ///< of each column, by its name
  bool poses_ = false;
};

}  // namespace beeline::internal
