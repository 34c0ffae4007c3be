#include <algorithm>
#include <cstring>

#include <beeline/error.h>
#include <beeline/io/text/internal/byte_blocks.h>
#include <beeline/io/text/internal/text_encoding.h>

namespace beeline::internal {

ByteBlocks::ByteBlocks(std::string_view bytes, const std::string& path)
    : path_(path), size_(bytes.size()), unread_(bytes) {}

ByteBlocks::ByteBlocks(InputFile& file)
    : path_(file.path()), size_(file.size().value_or(0)), file_(&file) {
  buffer_.resize(max_block);
}

/// Moves the unread bytes to the front of the buffer and reads up to `wanted` of them.
void ByteBlocks::fill(std::size_t wanted) {
  if (file_ == nullptr || unread_.size() >= wanted) return;
  const std::size_t kept = unread_.size();
  if (kept > 0) std::memmove(buffer_.data(), unread_.data(), kept);
  unread_ = {buffer_.data(), kept + file_->read(buffer_.data() + kept, max_block - kept)};
}

std::string_view ByteBlocks::peek(std::size_t wanted) {
  fill(wanted);
  return unread_.substr(0, wanted);
}

bool ByteBlocks::next_line(std::string_view& line) {
  if (line_end_ == '\0') {
    if (peek(utf8_mark.size()) == utf8_mark) skip(utf8_mark.size());
    const std::string_view front = peek(max_block);
    const bool alone = front.find('\n') == std::string_view::npos;
    line_end_ = alone && front.find('\r') != std::string_view::npos ? '\r' : '\n';
  }
  std::size_t end = unread_.find(line_end_);
  if (end == std::string_view::npos) {
    fill(max_block);
    end = unread_.find(line_end_);
  }
  if (end == std::string_view::npos && unread_.size() >= max_block) {
    throw FileError(path_, line_ + 1, "has a line longer than 1 MiB");
  }
  if (unread_.empty()) return false;
  line = unread_.substr(0, end);
  unread_.remove_prefix(std::min(line.size() + 1, unread_.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  ++line_;
  return true;
}

}  // namespace beeline::internal
