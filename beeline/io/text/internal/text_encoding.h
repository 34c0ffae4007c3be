#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <beeline/io/text/file.h>

namespace beeline::internal {

// Every reader of text begins with one of these. A text is UTF-8, with or without a byte order
// mark. Bytes that are not UTF-8 are accepted in comments; where they matter the reader refuses
// them with not_utf8().

/// The byte order mark of UTF-8.
inline constexpr std::string_view utf8_mark = "\xef\xbb\xbf";

/// What to do about a text with bytes that are not UTF-8.
inline constexpr const char* utf8_remedy = "perhaps Latin-1; save the file as UTF-8";

/// Returns the clause of an error for a text with bytes that are not UTF-8. It names the first.
std::string not_utf8(std::string_view text);

/// Returns the text of a file without its byte order mark. Throws FileError for text in UTF-16 or
/// UTF-32, with or without a mark, for a byte of 0, and for a pointer that Git LFS left in the
/// place of the file.
std::string_view text_in(std::string_view bytes, const std::string& path);

/// Throws FileError if a file that begins with these bytes is a pointer that Git LFS left in the
/// place of the file.
void refuse_lfs_pointer(std::string_view bytes, const std::string& path);
/// The number of bytes that refuse_lfs_pointer() reads.
inline constexpr std::size_t lfs_pointer_size = 40;

/// The same as text_in() for the front of a file that has not been read: skips its byte order mark.
void begin_text(InputFile& file);

/// Returns the first character of a text that is neither a blank nor part of a byte order mark; 0
/// if there is none. Readers of files without an ending recognise the format by it.
char first_character(std::string_view text);

/// Returns a text in Latin-1 (ISO 8859-1) as UTF-8.
std::string utf8_of_latin1(std::string_view text);

}  // namespace beeline::internal
