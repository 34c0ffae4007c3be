#include "saved_page.h"

#include <cstdint>
#include <filesystem>
#include <new>
#include <string_view>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/numbers.h>

#include <zlib.h>

namespace beeline::command {
namespace {

/// The stream of RFC 1951 that the page inflates.
std::string deflated(std::string content) {
  z_stream stream{};
  constexpr int without_header = -MAX_WBITS, memory_level = 8;
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, without_header, memory_level,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  std::string bytes(deflateBound(&stream, content.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(content.data());
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  deflate(&stream, Z_FINISH);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

/// base64 of RFC 4648 for addresses, - and _ for + and /, without padding.
std::string base64(const std::string& bytes) {
  constexpr const char* letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::string text;
  text.reserve(bytes.size() * 4 / 3 + 3);
  std::uint32_t held = 0;
  int bits = 0;
  for (const char byte : bytes) {
    held = held << 8 | static_cast<unsigned char>(byte);
    for (bits += 8; bits >= 6; bits -= 6) text += letters[held >> (bits - 6) & 63];
  }
  if (bits > 0) text += letters[held << (6 - bits) & 63];
  return text;
}

void fill(std::string& document, const std::string& name, const std::string& text) {
  const std::string begin = "<script type=\"text/plain\" id=\"saved-" + name + "\">";
  const std::size_t at = document.find(begin + "</script>");
  if (at == std::string::npos) throw Error("saved.html of the page has no element for " + name);
  document.insert(at + begin.size(), text);
}

}  // namespace

std::string saved_page(const std::string& folder, const PageSession& session) {
  const std::filesystem::path saved = std::filesystem::path(folder) / "saved.html";
  if (!std::filesystem::is_regular_file(saved)) {
    throw Error("the page in " + folder + " is of another version: no saved.html; run make web");
  }
  const std::string text = read_file(saved.string());
  const std::string_view marker = " data-file=\"", end = "\"></script>";
  std::string document;
  std::size_t from = 0;
  for (std::size_t at = text.find(marker); at != std::string::npos;
       at = text.find(marker, at + 1)) {
    const std::size_t name = at + marker.size(), quote = text.find('"', name);
    const bool is_part = quote != std::string::npos && text.compare(quote, end.size(), end) == 0;
    if (!is_part) continue;  // the page's own code
    const std::string file = text.substr(name, quote - name);
    document += text.substr(from, at - from) + ">";
    document += base64(deflated(read_file((saved.parent_path() / file).string())));
    from = quote + 2;
  }
  document += text.substr(from);
  std::string state = "json=" + base64(deflated(session.arm_document()));
  if (!session.section.empty()) state += "&section=" + session.section;
  if (!session.scene.empty()) state += "&scene=" + base64(deflated(session.scene));
  if (session.clearance) state += "&clearance=" + exact(*session.clearance);
  fill(document, "state", state);
  if (!session.trajectory.empty()) {
    fill(document, "trajectory", base64(deflated(session.trajectory)));
  }
  return document;
}

}  // namespace beeline::command
