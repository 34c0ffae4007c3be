#include <algorithm>
#include <array>
#include <stdexcept>

#include <beeline/reach/internal/zip_archive.h>

#include <zlib.h>

namespace beeline::internal {
namespace {

/// Little-endian numbers, one after the other.
class Record {
 public:
  Record& u16(std::uint64_t value) { return add(value, 2); }
  Record& u32(std::uint64_t value) { return add(value, 4); }
  Record& u64(std::uint64_t value) { return add(value, 8); }
  Record& text(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  Record& add(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xff);
    return *this;
  }
  std::string bytes_;
};

constexpr std::uint64_t zip_version = 45;        // ZIP64
constexpr std::uint64_t flags = 0x8;             // sizes and checksum follow the member
constexpr std::uint64_t deflated = 8;            // method
constexpr std::uint64_t day = 1 << 5 | 1;        // 1980-01-01: equal contents give equal files
constexpr std::uint64_t elsewhere = 0xffffffff;  // a size that the ZIP64 field has
constexpr std::uint64_t zip64 = 0x0001;

/// Version to the date: what the headers of a member have in common.
void add_common(Record& record) {
  record.u16(zip_version).u16(flags).u16(deflated).u16(0).u16(day);
}

}  // namespace

struct ZipArchive::Stream {
  Stream() {
    constexpr int level = 4, raw = -15, memory = 8;
    if (deflateInit2(&z, level, Z_DEFLATED, raw, memory, Z_DEFAULT_STRATEGY) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  ~Stream() { deflateEnd(&z); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  z_stream z{};
};

ZipArchive::ZipArchive(const std::string& path) : file_(path) {}
ZipArchive::~ZipArchive() = default;

void ZipArchive::write(std::string_view bytes) {
  file_.append(bytes);
  position_ += bytes.size();
}

void ZipArchive::begin_member(const std::string& name) {
  members_.push_back({.name = name, .begin = position_});
  Record header;
  header.u32(0x04034b50);
  add_common(header);
  header.u32(0).u32(elsewhere).u32(elsewhere).u16(name.size()).u16(20).text(name);
  header.u16(zip64).u16(16).u64(0).u64(0);
  write(header.bytes());
  stream_ = std::make_unique<Stream>();
}

void ZipArchive::compress(std::string_view bytes, bool last) {
  z_stream& z = stream_->z;
  // zlib does not change what it reads.
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  z.avail_in = static_cast<uInt>(bytes.size());
  std::array<char, 1 << 16> out;
  do {
    z.next_out = reinterpret_cast<Bytef*>(out.data());
    z.avail_out = static_cast<uInt>(out.size());
    deflate(&z, last ? Z_FINISH : Z_NO_FLUSH);
    const std::size_t count = out.size() - z.avail_out;
    members_.back().compressed += count;
    write({out.data(), count});
  } while (z.avail_out == 0);
}

void ZipArchive::append(std::string_view bytes) {
  constexpr std::size_t most = std::size_t{1} << 30;  // zlib counts in 32 bits
  for (; !bytes.empty(); bytes.remove_prefix(std::min(most, bytes.size()))) {
    const std::string_view some = bytes.substr(0, most);
    Member& member = members_.back();
    member.checksum = static_cast<std::uint32_t>(crc32(member.checksum,
                                                       reinterpret_cast<const Bytef*>(some.data()),
                                                       static_cast<uInt>(some.size())));
    member.size += some.size();
    compress(some, false);
  }
}

void ZipArchive::end_member() {
  compress({}, true);
  stream_.reset();
  const Member& member = members_.back();
  Record after;
  after.u32(0x08074b50).u32(member.checksum).u64(member.compressed).u64(member.size);
  write(after.bytes());
}

void ZipArchive::commit() {
  const std::uint64_t begin = position_;
  for (const Member& member : members_) {
    Record entry;
    entry.u32(0x02014b50).u16(zip_version);
    add_common(entry);
    entry.u32(member.checksum).u32(elsewhere).u32(elsewhere).u16(member.name.size()).u16(28);
    entry.u16(0).u16(0).u16(0).u32(0).u32(elsewhere).text(member.name);
    entry.u16(zip64).u16(24).u64(member.size).u64(member.compressed).u64(member.begin);
    write(entry.bytes());
  }
  const std::uint64_t end = position_, count = members_.size();
  Record last;
  last.u32(0x06064b50).u64(44).u16(zip_version).u16(zip_version).u32(0).u32(0);
  last.u64(count).u64(count).u64(end - begin).u64(begin);
  last.u32(0x07064b50).u32(0).u64(end).u32(1);
  last.u32(0x06054b50).u16(0).u16(0).u16(count).u16(count).u32(elsewhere).u32(elsewhere).u16(0);
  write(last.bytes());
  file_.commit();
}

}  // namespace beeline::internal
