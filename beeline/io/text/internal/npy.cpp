#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>

#include <beeline/error.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/npy.h>
#include <beeline/io/text/internal/text_encoding.h>

namespace beeline::internal {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied without conversion");

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t front_size = 128;  // a multiple of 64, as the format requires
constexpr std::size_t max_header = std::size_t{1} << 16;
constexpr std::int64_t max_size = std::int64_t{1} << 48;  // of rows and width: 2 PiB

std::int64_t bytes_of(const NpyHeader& header) { return header.single ? 4 : 8; }

/// Reads the Python literals of a header.
class Literals {
 public:
  explicit Literals(std::string_view text) : rest_(text) {}

  /// Skips blanks, then `word` if it follows; returns whether it did.
  bool take(std::string_view word) {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  void need(std::string_view word) {
    if (!take(word)) throw Error("its header lacks " + in_quotes(word) + before());
  }
  std::string_view text() {
    const char quote = take("'") ? '\'' : '"';
    if (quote == '"') need("\"");
    const std::size_t end = rest_.find(quote);
    if (end == std::string_view::npos) throw Error("its header has an unclosed quotation mark");
    const std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return found;
  }
  bool truth() {
    if (take("True")) return true;
    need("False");
    return false;
  }
  std::int64_t count() {
    take("");
    std::int64_t value = 0;
    const auto [end, fault] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (fault == std::errc::invalid_argument || value < 0) {
      throw Error("its header's shape needs whole numbers" + before());
    }
    if (fault != std::errc() || value > max_size) throw Error("its header's shape is too large");
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    take("L");  // as Python 2 wrote it
    return value;
  }
  bool at_end() {
    take("");
    return rest_.empty();
  }
  std::string before() const { return " before " + in_quotes(rest_.substr(0, 40)); }

 private:
  std::string_view rest_;
};

std::vector<std::int64_t> parse_shape(Literals& literals) {
  constexpr std::size_t max_dimensions = 32;  // numpy's own limit for long
  std::vector<std::int64_t> shape;
  literals.need("(");
  while (!literals.take(")")) {
    shape.push_back(literals.count());
    if (shape.size() > max_dimensions) throw Error("its header's shape has too many dimensions");
    if (literals.take(",")) continue;
    literals.need(")");
    break;
  }
  return shape;
}

bool parse_single(Literals& literals) {
  if (literals.take("[")) throw Error("its rows are records; they must be numbers");
  const std::string_view type = literals.text();
  if (type == "<f8") return false;
  if (type == "<f4") return true;
  throw Error("its numbers are of type " + in_quotes(type) +
              "; it needs '<f8' or '<f4': write array.astype('<f8')");
}

std::string quoted_shape(const std::vector<std::int64_t>& shape) {
  std::string text = "(";
  for (const std::int64_t size : shape) text += std::to_string(size) + ", ";
  if (shape.size() > 1) text.resize(text.size() - 2);
  return text + ")";
}

void apply_shape(const std::vector<std::int64_t>& shape, bool by_columns, NpyHeader& header) {
  if (shape.empty()) throw Error("it holds a single number; it needs rows of numbers");
  header.rows = shape[0];
  std::int64_t width = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) {
    if (shape[i] != 0 && width > max_size / shape[i])
      throw Error("its header's shape is too large");
    width *= shape[i];
  }
  if (width > std::numeric_limits<Eigen::Index>::max()) {  // 32 bits in WebAssembly
    throw Error("its header's shape is too large");
  }
  header.width = static_cast<Eigen::Index>(width);
  if (shape.size() > 1) header.last = static_cast<Eigen::Index>(shape.back());
  // Both orders are the same when at most one dimension exceeds 1.
  const auto long_dimensions =
      std::count_if(shape.begin(), shape.end(), [](std::int64_t size) { return size > 1; });
  if (by_columns && long_dimensions > 1) {
    throw Error("its array " + quoted_shape(shape) +
                " is in column-major order (fortran_order); write np.ascontiguousarray(array)");
  }
}

}  // namespace

NpyHeader parse_npy_header(std::string_view dictionary) {
  NpyHeader header;
  Literals literals(dictionary);
  std::vector<std::int64_t> shape;
  bool by_columns = false, has_type = false, has_order = false, has_shape = false;
  const auto once = [](bool& found, const char* key) {
    if (found) throw Error("its header has " + in_quotes(key) + " twice");
    found = true;
  };
  literals.need("{");
  while (!literals.take("}")) {
    const std::string_view key = literals.text();
    literals.need(":");
    if (key == "descr") {
      once(has_type, "descr");
      header.single = parse_single(literals);
    } else if (key == "fortran_order") {
      once(has_order, "fortran_order");
      by_columns = literals.truth();
    } else if (key == "shape") {
      once(has_shape, "shape");
      shape = parse_shape(literals);
    } else {
      throw Error("its header has an unknown key " + in_quotes(key));
    }
    if (literals.take(",")) continue;
    literals.need("}");
    break;
  }
  if (!literals.at_end()) throw Error("its header has text after its end" + literals.before());
  if (!has_type || !has_order || !has_shape) {
    throw Error("its header needs descr, fortran_order and shape");
  }
  apply_shape(shape, by_columns, header);
  return header;
}

std::string npy_front(const NpyHeader& header) {
  std::string front(magic);
  front += '\x01';
  front += '\0';
  constexpr std::size_t length = front_size - 10;
  front += static_cast<char>(length & 0xff);
  front += static_cast<char>(length >> 8);
  front += std::string("{'descr': '") + (header.single ? "<f4" : "<f8") +
           "', 'fortran_order': False, 'shape': (" + std::to_string(header.rows) + ", " +
           std::to_string(header.width) + "), }";
  front.resize(front_size - 1, ' ');
  return front + '\n';
}

NpyReader::NpyReader(const std::string& path) : file_(path) {
  try {
    read_header();
    check_size();
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
  left_ = header_.rows;
}

void NpyReader::read_header() {
  refuse_lfs_pointer(file_.peek(lfs_pointer_size), file_.path());
  std::string start(8, '\0');
  if (file_.read(start.data(), 8) < 8 || !start.starts_with(magic)) {
    throw Error("is not an .npy file: it does not begin with the bytes \\x93NUMPY");
  }
  const int version = static_cast<unsigned char>(start[6]);
  if (version < 1 || version > 3) {
    throw Error("is of version " + std::to_string(version) +
                " of the format; supported are 1 to 3");
  }
  const std::size_t digits = version == 1 ? 2 : 4;
  unsigned char bytes[4] = {};
  if (file_.read(reinterpret_cast<char*>(bytes), digits) < digits) throw Error("is truncated");
  std::size_t length = 0;
  for (std::size_t i = 0; i < digits; ++i) length |= std::size_t{bytes[i]} << (8 * i);
  if (length > max_header) {
    throw Error("has a header of " + std::to_string(length) + " bytes; at most " +
                std::to_string(max_header) + " are read");
  }
  std::string dictionary(length, '\0');
  if (file_.read(dictionary.data(), length) < length) throw Error("is truncated within its header");
  header_ = parse_npy_header(dictionary);
}

void NpyReader::check_size() const {
  if (!file_.size()) return;  // a pipe: checked at its end
  const std::uint64_t following = *file_.size() - std::min(*file_.size(), file_.position());
  const auto row = static_cast<std::uint64_t>(header_.width * bytes_of(header_));
  const std::uint64_t present = row == 0 ? 0 : following / row;
  const auto declared = static_cast<std::uint64_t>(header_.rows);
  if (row != 0 && present < declared) {
    throw Error("declares " + std::to_string(declared) + " rows of " +
                std::to_string(header_.width) + " numbers and has " + std::to_string(present));
  }
  if (following > declared * row) {  // no overflow: declared <= present, or row is 0
    throw Error("has " + std::to_string(following - declared * row) + " bytes after its " +
                std::to_string(declared) + " rows of " + std::to_string(header_.width) +
                " numbers");
  }
}

Eigen::Index NpyReader::read(Eigen::Ref<Eigen::MatrixXd> block) {
  if (block.rows() != header_.width || block.outerStride() != block.rows()) {
    throw Error("a block for rows of " + std::to_string(header_.width) +
                " numbers must have that many rows, stored contiguously");
  }
  const auto rows = static_cast<Eigen::Index>(std::min<std::int64_t>(left_, block.cols()));
  const auto numbers = static_cast<std::size_t>(rows * header_.width);
  const std::size_t wanted = numbers * static_cast<std::size_t>(bytes_of(header_));
  std::size_t count = 0;
  if (header_.single) {
    singles_.resize(numbers);
    count = file_.read(reinterpret_cast<char*>(singles_.data()), wanted);
    std::copy(singles_.begin(), singles_.end(), block.data());
  } else {
    count = file_.read(reinterpret_cast<char*>(block.data()), wanted);
  }
  if (count < wanted) {
    const std::int64_t whole =
        header_.rows - left_ +
        static_cast<std::int64_t>(count) / (bytes_of(header_) * header_.width);
    throw FileError(file_.path(), 0,
                    "declares " + std::to_string(header_.rows) + " rows of " +
                        std::to_string(header_.width) + " numbers and has " +
                        std::to_string(whole));
  }
  left_ -= rows;
  if (left_ == 0 && rows > 0) check_end();
  return rows;
}

/// Refuses a pipe that continues after its last row. The size of a file is checked before.
void NpyReader::check_end() {
  char more = 0;
  if (file_.size() || file_.read(&more, 1) == 0) return;
  throw FileError(file_.path(), 0,
                  "has more than its " + std::to_string(header_.rows) + " rows of " +
                      std::to_string(header_.width) + " numbers");
}

NpyWriter::NpyWriter(const std::string& path, Eigen::Index width, bool single)
    : file_(path), header_{single, 0, width} {
  if (!file_.replaces()) {
    throw Error(
        path +
        " is a pipe or a device; .npy needs a file, because its number of rows is written last");
  }
  file_.append(npy_front(header_));
}

void NpyWriter::write(const Eigen::Ref<const Eigen::MatrixXd>& block) {
  if (block.rows() != header_.width || block.outerStride() != block.rows()) {
    throw Error("a block of rows of " + std::to_string(header_.width) +
                " numbers must have that many rows, stored contiguously");
  }
  const auto numbers = static_cast<std::size_t>(block.size());
  if (header_.single && block.size() > 0) {
    if (block.cwiseAbs().maxCoeff<Eigen::PropagateNumbers>() > std::numeric_limits<float>::max()) {
      throw Error("a number is too large for 32 bits");
    }
    singles_ = block.cast<float>();
    file_.append({reinterpret_cast<const char*>(singles_.data()), numbers * sizeof(float)});
  } else {
    file_.append({reinterpret_cast<const char*>(block.data()), numbers * sizeof(double)});
  }
  header_.rows += block.cols();
}

void NpyWriter::commit() {
  file_.overwrite_front(npy_front(header_));
  file_.commit();
}

}  // namespace beeline::internal
