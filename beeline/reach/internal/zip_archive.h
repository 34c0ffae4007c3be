#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/internal/file_stream.h>

namespace beeline::internal {

/// Writes a ZIP archive (PKWARE's APPNOTE 6.3.3, with ZIP64) of compressed members of any size, one
/// after the other.
class ZipArchive {
 public:
  explicit ZipArchive(const std::string& path);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  void begin_member(const std::string& name);
  void append(std::string_view bytes);
  void end_member();
  /// Writes the directory of the archive and commits the file.
  void commit();

 private:
  struct Member {
    std::string name;
    std::uint64_t begin = 0;  ///< of its header in the archive
    std::uint64_t size = 0, compressed = 0;
    std::uint32_t checksum = 0;
  };
  struct Stream;

  void write(std::string_view bytes);
  void compress(std::string_view bytes, bool last);

  OutputFile file_;
  std::uint64_t position_ = 0;
  std::vector<Member> members_;
  std::unique_ptr<Stream> stream_;  ///< of the member that is being written
};

}  // namespace beeline::internal
