#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include <beeline/error.h>
#include <beeline/io/text/internal/mesh_file.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/ply.h>
#include <beeline/io/text/internal/point_cloud.h>

namespace beeline::internal {
namespace {

enum class Encoding { ascii, little_endian, big_endian };

/// A type of numbers, with its two names.
struct NumberType {
  std::array<std::string_view, 2> names;
  std::size_t size;  ///< bytes
  bool is_float = false;
};
constexpr NumberType number_types[] = {
    {{"char", "int8"}, 1},           {{"uchar", "uint8"}, 1},         {{"short", "int16"}, 2},
    {{"ushort", "uint16"}, 2},       {{"int", "int32"}, 4},           {{"uint", "uint32"}, 4},
    {{"float", "float32"}, 4, true}, {{"double", "float64"}, 8, true}};

struct Property {
  std::string name = {};
  const NumberType* type = nullptr;   ///< of the number, or of the items of the list
  const NumberType* count = nullptr;  ///< of the number of items, if it is a list
};

struct Element {
  std::string name = {};
  std::uint64_t count = 0;
  std::vector<Property> properties = {};
};

class PlyHeader {
 public:
  explicit PlyHeader(ByteBlocks& bytes) : bytes_(bytes) {
    std::string_view line;
    if (!bytes.next_line(line) || take_word(line) != "ply") {
      throw FileError(bytes.path(), 0, "is not a PLY file: it does not begin with \"ply\"");
    }
    for (int lines = 0; bytes.next_line(line) && lines < 10'000; ++lines) {
      const std::string_view statement = take_word(line);
      if (statement == "end_header") {
        check();
        return;
      }
      if (statement == "format") {
        take_format(line);
      } else if (statement == "element") {
        take_element(line);
      } else if (statement == "property") {
        take_property(line);
      } else if (!statement.empty() && statement != "comment" && statement != "obj_info") {
        refuse("has a statement " + in_quotes(statement) + " in its header");
      }
    }
    throw FileError(bytes.path(), 0, "has no end_header within its first 10,000 lines");
  }

  Encoding encoding() const { return *encoding_; }
  const std::vector<Element>& elements() const { return elements_; }

 private:
  [[noreturn]] void refuse(const std::string& fault) const {
    throw FileError(bytes_.path(), bytes_.line(), fault);
  }

  void take_format(std::string_view line) {
    const std::string_view name = take_word(line), version = take_word(line);
    if (name == "ascii") encoding_ = Encoding::ascii;
    if (name == "binary_little_endian") encoding_ = Encoding::little_endian;
    if (name == "binary_big_endian") encoding_ = Encoding::big_endian;
    if (!encoding_ || version != "1.0") {
      refuse("is of the format " + in_quotes(name) + " " + in_quotes(version) +
             "; known are ascii, binary_little_endian and binary_big_endian, 1.0");
    }
  }

  void take_element(std::string_view line) {
    Element element{.name = std::string(take_word(line))};
    const std::string_view digits = take_word(line);
    const auto [end, fault] =
        std::from_chars(digits.data(), digits.data() + digits.size(), element.count);
    if (digits.empty() || fault != std::errc() || end != digits.data() + digits.size()) {
      refuse("has an element with the number " + in_quotes(digits));
    }
    for (const Element& other : elements_) {
      if (other.name == element.name) refuse("has the element " + in_quotes(other.name) + " twice");
    }
    elements_.push_back(std::move(element));
  }

  const NumberType& type_named(std::string_view name) const {
    for (const NumberType& type : number_types) {
      if (name == type.names[0] || name == type.names[1]) return type;
    }
    refuse("has a property of the type " + in_quotes(name));
  }

  void take_property(std::string_view line) {
    if (elements_.empty()) refuse("has a property in front of its elements");
    Property property;
    std::string_view type = take_word(line);
    if (type == "list") {
      property.count = &type_named(take_word(line));
      if (property.count->is_float) refuse("has a list whose number of items is a float");
      type = take_word(line);
    }
    property.type = &type_named(type);
    property.name = std::string(take_word(line));
    elements_.back().properties.push_back(std::move(property));
  }

  void check() const {
    if (!encoding_) throw FileError(bytes_.path(), 0, "has no format in its header");
  }

  ByteBlocks& bytes_;
  std::optional<Encoding> encoding_;
  std::vector<Element> elements_;
};

/// Reads the rows of elements, one number after the other.
class PlyRows {
 public:
  PlyRows(ByteBlocks& bytes, Encoding encoding) : bytes_(bytes), encoding_(encoding) {}

  /// Calls `found` with the index of each property that is no list, and its number.
  template <class Found>
  void read_row(const Element& element, std::uint64_t row, const Found& found) {
    if (encoding_ == Encoding::ascii && !bytes_.next_line(line_)) cut_off(element, row);
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (property.count == nullptr) {
        found(i, [&] { return number(*property.type, element, row); });
        continue;
      }
      const double count = number(*property.count, element, row);
      if (!(count >= 0 && count == std::floor(count))) {
        throw FileError(bytes_.path(), line(),
                        "has a list of " + beeline::number(count) + " items");
      }
      for (double k = 0; k < count; ++k) skip(*property.type, element, row);
    }
    const std::string_view more = take_word(line_);
    if (!more.empty()) {
      throw FileError(bytes_.path(), line(),
                      printable(element.name) + " " + std::to_string(row) + " has " +
                          in_quotes(more) + " behind its properties");
    }
  }

  /// Refuses what follows the rows of the last element, except blank lines of ASCII.
  void check_end(const Element& last) {
    bool more = encoding_ != Encoding::ascii && !bytes_.peek(1).empty();
    while (encoding_ == Encoding::ascii && !more && bytes_.next_line(line_)) {
      more = !take_word(line_).empty();
    }
    if (!more) return;
    throw FileError(bytes_.path(), line(),
                    "continues after its " + std::to_string(last.count) + " rows of " +
                        printable(last.name) + "; does its header have an old number?");
  }

  void skip(const NumberType& type, const Element& element, std::uint64_t row) {
    if (encoding_ == Encoding::ascii) {
      if (take_word(line_).empty()) cut_off(element, row);
    } else {
      take(type.size, element, row);
    }
  }

 private:
  int line() const { return encoding_ == Encoding::ascii ? bytes_.line() : 0; }

  [[noreturn]] void cut_off(const Element& element, std::uint64_t row) const {
    throw FileError(bytes_.path(), line(),
                    "is cut off at " + printable(element.name) + " " + std::to_string(row) +
                        " of " + std::to_string(element.count));
  }

  std::string_view take(std::size_t size, const Element& element, std::uint64_t row) {
    const std::string_view found = bytes_.peek(size);
    if (found.size() < size) cut_off(element, row);
    std::copy(found.begin(), found.end(), taken_.begin());
    bytes_.skip(size);
    return {taken_.data(), size};
  }

  double number(const NumberType& type, const Element& element, std::uint64_t row) {
    if (encoding_ == Encoding::ascii) {
      try {
        return take_number(line_, bytes_);
      } catch (const FileError& error) {
        throw error.behind(printable(element.name) + " " + std::to_string(row) + ": ");
      }
    }
    take(type.size, element, row);
    if (encoding_ == Encoding::big_endian) std::reverse(taken_.begin(), taken_.begin() + type.size);
    const auto value_as = [&](auto value) {
      std::memcpy(&value, taken_.data(), sizeof value);
      return static_cast<double>(value);
    };
    if (type.is_float) return type.size == 4 ? value_as(float()) : value_as(double());
    const bool is_signed = type.names[0].front() != 'u';
    if (type.size == 1) return is_signed ? value_as(std::int8_t()) : value_as(std::uint8_t());
    if (type.size == 2) return is_signed ? value_as(std::int16_t()) : value_as(std::uint16_t());
    return is_signed ? value_as(std::int32_t()) : value_as(std::uint32_t());
  }

  ByteBlocks& bytes_;
  Encoding encoding_;
  std::string_view line_;
  std::array<char, 8> taken_{};
};

/// The places of x, y and z among the properties of the vertices.
std::array<std::size_t, 3> coordinate_places(const Element& vertex, const std::string& path) {
  constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
  std::array<std::size_t, 3> places{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto is_it = [&](const Property& property) { return property.name == names[axis]; };
    const auto& properties = vertex.properties;
    const auto found = std::find_if(properties.begin(), properties.end(), is_it);
    const std::string wanted =
        "a property " + std::string(names[axis]) + ", float or double, of the element vertex";
    if (found == properties.end()) throw FileError(path, 0, "lacks " + wanted);
    if (found->count != nullptr || !found->type->is_float ||
        std::count_if(properties.begin(), properties.end(), is_it) > 1) {
      throw FileError(path, 0, "must have one property " + wanted.substr(11));
    }
    places[axis] = static_cast<std::size_t>(found - properties.begin());
  }
  return places;
}

void skip_rows(PlyRows& rows, const Element& element) {
  if (element.properties.empty()) return;
  for (std::uint64_t row = 0; row < element.count; ++row) {
    rows.read_row(element, row, [&](std::size_t i, const auto&) {
      rows.skip(*element.properties[i].type, element, row);
    });
  }
}

std::vector<Vector3> vertices_of(PlyRows& rows, const Element& vertex, const std::string& path) {
  check_point_count(vertex.count, path);
  const std::array<std::size_t, 3> places = coordinate_places(vertex, path);
  std::vector<Vector3> points;
  for (std::uint64_t row = 0; row < vertex.count; ++row) {
    Vector3 point;
    rows.read_row(vertex, row, [&](std::size_t i, const auto& number) {
      const auto place = std::find(places.begin(), places.end(), i);
      if (place == places.end()) return rows.skip(*vertex.properties[i].type, vertex, row);
      point[place - places.begin()] = number();
    });
    points.push_back(point);
  }
  return points;
}

}  // namespace

std::vector<Vector3> points_from_ply(ByteBlocks& bytes) {
  const PlyHeader header(bytes);
  PlyRows rows(bytes, header.encoding());
  const std::vector<Element>& elements = header.elements();
  const auto is_vertex = [](const Element& element) { return element.name == "vertex"; };
  const auto vertex = std::find_if(elements.begin(), elements.end(), is_vertex);
  if (vertex == elements.end()) throw FileError(bytes.path(), 0, "has no element vertex");
  for (auto before = elements.begin(); before != vertex; ++before) skip_rows(rows, *before);
  std::vector<Vector3> points = vertices_of(rows, *vertex, bytes.path());
  const auto has_rows = [](const Element& element) { return element.count > 0; };
  if (std::none_of(vertex + 1, elements.end(), has_rows)) rows.check_end(*vertex);
  return points;
}

}  // namespace beeline::internal
