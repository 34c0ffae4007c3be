#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace beeline::internal {

/// The hash of a sequence of bytes and numbers: FNV-1a, 64 bits. It is the same on every machine,
/// and differs where two sequences differ, except by chance.
class Fingerprint {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) add_byte(static_cast<unsigned char>(c));
  }
  void add(std::uint64_t number) {
    for (int k = 0; k < 64; k += 8) add_byte(static_cast<unsigned char>(number >> k));
  }
  void add(double number) {
    const double value = number + 0.0;  // -0 becomes 0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
  }

  /// Returns 16 hexadecimal digits.
  std::string text() const {
    std::string digits;
    for (int k = 60; k >= 0; k -= 4) digits += "0123456789abcdef"[hash_ >> k & 15];
    return digits;
  }

 private:
  void add_byte(unsigned char byte) { hash_ = (hash_ ^ byte) * 0x100000001b3; }

  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace beeline::internal
