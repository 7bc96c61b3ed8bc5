#include "formats/json/cbor_writer.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

namespace graycube {
namespace {

enum Major : std::uint8_t {
  kUnsigned = 0,
  kNegative = 1,
  kText = 3,
  kArray = 4,
  kMap = 5,
  kSimple = 7
};
constexpr std::uint8_t kFalse = 20, kTrue = 21, kNull = 22, kSingle = 26, kDouble = 27;
/// Integers up to here are written as integers; beyond, doubles are as short.
constexpr double kMaxInteger = 4294967296.0;

class CborWriter {
 public:
  explicit CborWriter(const JsonTree& tree) : tree_(tree) {}

  std::string write() {
    bytes_ = kCborMagic;
    value(0);
    return std::move(bytes_);
  }

 private:
  void initial(Major major, std::uint8_t info) {
    bytes_ += static_cast<char>(static_cast<unsigned>(major) << 5 | info);
  }
  /// Appends the lower `count` bytes, the most significant first.
  void big_endian(std::uint64_t bits, int count) {
    for (int i = count - 1; i >= 0; --i) bytes_ += static_cast<char>(bits >> (8 * i) & 0xFF);
  }
  void head(Major major, std::uint64_t n) {
    if (n < 24) return initial(major, static_cast<std::uint8_t>(n));
    const int log = n <= 0xFF ? 0 : n <= 0xFFFF ? 1 : n <= 0xFFFFFFFF ? 2 : 3;
    initial(major, static_cast<std::uint8_t>(24 + log));
    big_endian(n, 1 << log);
  }
  void string(std::string_view s) {
    head(kText, s.size());
    bytes_ += s;
  }
  void number(double v) {
    const bool is_integer =
        v == std::floor(v) && std::fabs(v) < kMaxInteger && !(v == 0 && std::signbit(v));
    if (is_integer) {
      return v >= 0 ? head(kUnsigned, static_cast<std::uint64_t>(v))
                    : head(kNegative, static_cast<std::uint64_t>(-v) - 1);
    }
    const auto single = static_cast<float>(v);
    if (static_cast<double>(single) == v) {
      initial(kSimple, kSingle);
      return big_endian(std::bit_cast<std::uint32_t>(single), 4);
    }
    initial(kSimple, kDouble);
    big_endian(std::bit_cast<std::uint64_t>(v), 8);
  }
  void value(JsonIndex i) {
    switch (tree_.kind(i)) {
      case JsonKind::kNull: return initial(kSimple, kNull);
      case JsonKind::kFalse: return initial(kSimple, kFalse);
      case JsonKind::kTrue: return initial(kSimple, kTrue);
      case JsonKind::kNumber: return number(tree_.number(i));
      case JsonKind::kString: return string(tree_.string(i));
      case JsonKind::kArray: head(kArray, tree_.size(i)); break;
      case JsonKind::kObject: head(kMap, tree_.size(i)); break;
    }
    for (JsonIndex c = tree_.first_child(i); c != tree_.end(i); c = tree_.next(c)) {
      if (tree_.kind(i) == JsonKind::kObject) string(tree_.key(c));
      value(c);
    }
  }

  const JsonTree& tree_;
  std::string bytes_;
};

}  // namespace

std::string cbor_of(const JsonTree& tree) { return CborWriter(tree).write(); }

}  // namespace graycube
