#include <algorithm>

#include <beeline/error.h>
#include <beeline/internal/utf8.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/text_encoding.h>

namespace beeline::internal {
namespace {

constexpr std::string_view lfs_pointer = "version https://git-lfs.github.com/spec/";
static_assert(lfs_pointer.size() == lfs_pointer_size);

/// Returns the name of the encoding if a text begins as one with units of two or four bytes, empty
/// otherwise. Without a byte order mark the zero byte of its first character, which is ASCII in all
/// of our formats, gives it away; UTF-8 text has none.
std::string wide_encoding(std::string_view bytes) {
  using namespace std::string_view_literals;
  const auto zero = [&](std::size_t i) { return i < bytes.size() && bytes[i] == 0; };
  const auto other = [&](std::size_t i) {
    return i < bytes.size() &&
           ((bytes[i] >= '\t' && bytes[i] <= '\r') || (bytes[i] >= ' ' && bytes[i] <= '~'));
  };
  if (bytes.starts_with("\xff\xfe\0\0"sv) || bytes.starts_with("\0\0\xfe\xff"sv)) return "UTF-32";
  if (bytes.starts_with("\xff\xfe"sv) || bytes.starts_with("\xfe\xff"sv)) return "UTF-16";
  if (other(0) && zero(1) && zero(2) && zero(3)) return "UTF-32";
  if (zero(0) && zero(1) && zero(2) && other(3)) return "UTF-32";
  if ((other(0) && zero(1)) || (zero(0) && other(1))) return "UTF-16";
  return "";
}

}  // namespace

std::string not_utf8(std::string_view text) {
  while (!text.empty() && utf8_length(text) > 0) text.remove_prefix(utf8_length(text));
  const std::string byte = with_escaped_bytes(text.substr(0, 1));  // \xfc
  return "is not UTF-8 text (byte 0" + byte.substr(std::min<std::size_t>(1, byte.size())) + "), " +
         utf8_remedy;
}

std::string_view text_in(std::string_view bytes, const std::string& path) {
  const std::string encoding = wide_encoding(bytes);
  if (!encoding.empty()) throw FileError(path, 0, "is " + encoding + "; save it as UTF-8");
  if (bytes.starts_with(utf8_mark)) bytes.remove_prefix(utf8_mark.size());
  refuse_lfs_pointer(bytes, path);
  const std::size_t zero = bytes.find('\0');
  if (zero == std::string_view::npos) return bytes;
  const auto line = 1 + std::count(bytes.begin(), bytes.begin() + zero, '\n');
  throw FileError(path, static_cast<int>(line),
                  "has a byte of 0, which no text has; the file is binary or damaged");
}

void refuse_lfs_pointer(std::string_view bytes, const std::string& path) {
  if (!bytes.starts_with(lfs_pointer)) return;
  throw FileError(path, 0,
                  "is a pointer of Git LFS, not the file itself; git lfs pull downloads the file");
}

void begin_text(InputFile& file) {
  const std::string_view front = file.peek(utf8_mark.size() + lfs_pointer_size);
  char mark[utf8_mark.size()];
  (void)file.read(mark, front.size() - text_in(front, file.path()).size());
}

char first_character(std::string_view text) {
  if (text.starts_with(utf8_mark)) text.remove_prefix(utf8_mark.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? '\0' : text[first];
}

std::string utf8_of_latin1(std::string_view text) {
  std::string utf8;
  utf8.reserve(text.size());
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      utf8 += c;
    } else {
      utf8 += static_cast<char>(0xc0 | byte >> 6);
      utf8 += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return utf8;
}

}  // namespace beeline::internal
