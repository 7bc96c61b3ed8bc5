// Fills a JsonTree from CBOR (RFC 8949). What our writer writes is read in one plain loop; at the first thing that is wrong or
// unusual that gives up, and nlohmann's parser reads the bytes again: it decides what is CBOR here, and words what is wrong.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/json_tree.hpp"
#include "scene/tracked_text.hpp"

namespace graycube {
namespace {

using Json = nlohmann::json;

}  // namespace

/// The library calls what has the names of its json_sax.
class CborEvents {
 public:
  CborEvents(std::string_view bytes, JsonTree& tree) : bytes_(bytes), tree_(tree) {}

  void parse() {
    const char* const begin = bytes_.data() + kCborMagic.size();
    reached_ = begin;
    Json::sax_parse(TrackedText(begin, &reached_), TrackedText(bytes_.data() + bytes_.size(), &reached_), this,
                    Json::input_format_t::cbor, true);
    // Also after a failure, so that pointers to what was read stay right.
    while (!open_.empty()) close();
  }

  /// False for anything but heads with a length, doubles, singles, and no end but the right one; the tree then
  /// holds anything.
  bool parse_fast() {
    const char* at = bytes_.data() + kCborMagic.size();
    const char* const end = bytes_.data() + bytes_.size();
    std::vector<Level> levels;
    do {
      const bool wants_key = !levels.empty() && levels.back().is_map && key_.begin == 0;
      reached_ = at;
      Head head;
      if (!read_head(reached_, end, head)) return false;
      if (wants_key && head.major != kText) return false;
      if (head.major == kText) {
        if (head.argument > kMaxJsonString || static_cast<std::size_t>(end - reached_) < head.argument) return false;
        const Text text{static_cast<std::uint32_t>(offset()), static_cast<std::uint32_t>(head.argument), false};
        reached_ += head.argument;
        at = reached_;
        if (wants_key) {
          key_ = text;
          continue;
        }
        add_unchecked(JsonKind::kString, std::uint64_t{text.begin} << 32 | text.length, levels);
      } else if (head.major == kArray || head.major == kMap) {
        at = reached_;
        if (levels.size() >= kMaxJsonNesting) return false;
        const auto self = static_cast<JsonIndex>(tree_.values_.size());
        add_unchecked(head.major == kMap ? JsonKind::kObject : JsonKind::kArray, 0, levels);
        levels.push_back({self, head.argument, head.major == kMap});
      } else {
        JsonKind kind = JsonKind::kNumber;
        double number = 0;
        if (!scalar_of(head, kind, number)) return false;
        at = reached_;
        add_unchecked(kind, kind == JsonKind::kNumber ? std::bit_cast<std::uint64_t>(number) : 0, levels);
      }
      if (tree_.values_.size() >= kMaxCborValues) return false;
      while (!levels.empty() && levels.back().left == 0) {
        tree_.values_[levels.back().self].next = static_cast<JsonIndex>(tree_.values_.size());
        levels.pop_back();
      }
    } while (!levels.empty());
    return at == end;
  }

  bool null() { return add(JsonKind::kNull) != nullptr; }
  bool boolean(bool value) { return add(value ? JsonKind::kTrue : JsonKind::kFalse) != nullptr; }
  bool number_integer(Json::number_integer_t value) { return add_number(static_cast<double>(value)); }
  bool number_unsigned(Json::number_unsigned_t value) { return add_number(static_cast<double>(value)); }
  bool number_float(double value, std::string_view) {
    if (!std::isfinite(value)) return fail(offset(), "expected a finite number");
    return add_number(value);
  }
  bool string(std::string_view value) {
    Text text;
    JsonTree::Value* added = keep(value, text) ? add(JsonKind::kString) : nullptr;
    if (added == nullptr) return false;
    added->payload = std::uint64_t{text.begin} << 32 | text.length;
    added->string_is_decoded = text.decoded;
    return true;
  }
  bool key(std::string_view value) { return keep(value, key_); }
  bool start_object(std::size_t) { return open(JsonKind::kObject); }
  bool start_array(std::size_t) { return open(JsonKind::kArray); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool binary(Json::binary_t&) { return fail(offset(), "byte strings are not accepted"); }

  /// `position` counts the bytes read behind the magic, the end as one.
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) {
    std::string_view why = error.what();
    constexpr std::string_view kParsing = "while parsing ";
    const std::size_t parsing = why.find(kParsing);
    if (parsing != std::string_view::npos) why.remove_prefix(parsing + kParsing.size());
    const std::size_t last = kCborMagic.size() + (position > 0 ? position - 1 : 0);
    return fail(std::min(last, bytes_.size()), std::string(why));
  }

 private:
  /// A string as found: a range of the bytes, or an index into the tree's decoded strings.
  struct Text {
    std::uint32_t begin = 0, length = 0;
    bool decoded = false;
  };

  enum Major : std::uint8_t { kUnsigned = 0, kNegative = 1, kText = 3, kArray = 4, kMap = 5, kSimple = 7 };
  /// The first bytes of a value.
  struct Head {
    std::uint8_t major = 0, info = 0;
    std::uint64_t argument = 0;
  };
  struct Level {
    JsonIndex self;
    /// Elements or members still to come.
    std::uint64_t left;
    bool is_map;
  };

  static bool read_head(const char*& at, const char* end, Head& head) {
    if (at == end) return false;
    const auto first = static_cast<std::uint8_t>(*at++);
    head = {static_cast<std::uint8_t>(first >> 5), static_cast<std::uint8_t>(first & 31), first & 31u};
    if (head.info < 24) return true;
    if (head.info > 27) return false;
    const int count = 1 << (head.info - 24);
    if (end - at < count) return false;
    head.argument = 0;
    for (int i = 0; i < count; ++i) head.argument = head.argument << 8 | static_cast<std::uint8_t>(*at++);
    return true;
  }

  static bool scalar_of(const Head& head, JsonKind& kind, double& number) {
    if (head.major == kUnsigned) {
      number = static_cast<double>(head.argument);
    } else if (head.major == kNegative) {
      number = static_cast<double>(-1 - static_cast<std::int64_t>(head.argument));
      return head.argument >> 63 == 0;
    } else if (head.major != kSimple) {
      return false;
    } else if (head.info == 27) {
      number = std::bit_cast<double>(head.argument);
    } else if (head.info == 26) {
      number = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(head.argument)));
    } else if (head.info >= 20 && head.info <= 22) {
      kind = head.info == 20 ? JsonKind::kFalse : head.info == 21 ? JsonKind::kTrue : JsonKind::kNull;
    } else {
      return false;
    }
    return std::isfinite(number);
  }

  void add_unchecked(JsonKind kind, std::uint64_t payload, std::vector<Level>& levels) {
    const auto self = static_cast<JsonIndex>(tree_.values_.size());
    if (!levels.empty()) {
      ++tree_.values_[levels.back().self].payload;
      --levels.back().left;
    }
    tree_.values_.push_back({payload, static_cast<std::uint32_t>(offset()), self + 1, key_.begin,
                             static_cast<std::uint16_t>(key_.length), kind, false, false});
    key_ = {};
  }

  /// Just behind the last byte that the library has read.
  std::size_t offset() const { return static_cast<std::size_t>(reached_ - bytes_.data()); }

  /// Null after a failure.
  JsonTree::Value* add(JsonKind kind) {
    const auto self = static_cast<JsonIndex>(tree_.values_.size());
    if (self == kMaxCborValues) {
      fail(offset(), "more than " + std::to_string(kMaxCborValues) + " values");
      return nullptr;
    }
    if (!open_.empty()) ++tree_.values_[open_.back()].payload;
    JsonTree::Value& value = tree_.values_.emplace_back();
    value.kind = kind;
    value.begin = static_cast<std::uint32_t>(offset());
    value.next = self + 1;
    value.key_begin = key_.begin;
    value.key_length = static_cast<std::uint16_t>(key_.length);
    value.key_is_decoded = key_.decoded;
    key_ = {};
    return &value;
  }

  bool add_number(double number) {
    JsonTree::Value* added = add(JsonKind::kNumber);
    if (added != nullptr) added->payload = std::bit_cast<std::uint64_t>(number);
    return added != nullptr;
  }

  bool open(JsonKind kind) {
    const auto self = static_cast<JsonIndex>(tree_.values_.size());
    if (add(kind) == nullptr) return false;
    if (open_.size() >= kMaxJsonNesting) {
      return fail(offset(), "arrays and maps nest deeper than " + std::to_string(kMaxJsonNesting));
    }
    open_.push_back(self);
    return true;
  }
  bool close() {
    tree_.values_[open_.back()].next = static_cast<JsonIndex>(tree_.values_.size());
    open_.pop_back();
    return true;
  }

  /// A string in one piece stays among the bytes; one in chunks is copied.
  bool keep(std::string_view value, Text& out) {
    if (value.size() > kMaxJsonString) {
      return fail(offset(), "a string is longer than " + std::to_string(kMaxJsonString) + " bytes");
    }
    out.length = static_cast<std::uint32_t>(value.size());
    out.decoded = bytes_.substr(offset() - value.size(), value.size()) != value;
    out.begin = static_cast<std::uint32_t>(out.decoded ? tree_.decoded_.size() : offset() - value.size());
    if (out.decoded) tree_.decoded_.emplace_back(value);
    return true;
  }

  bool fail(std::size_t at, std::string message) {
    const std::size_t count = tree_.values_.size();
    tree_.syntax_error_ = {at, static_cast<JsonIndex>(count == 0 ? 0 : count - 1), std::move(message)};
    return false;
  }

  std::string_view bytes_;
  JsonTree& tree_;
  const char* reached_ = nullptr;
  std::vector<JsonIndex> open_;  // containers around the next value, outermost first
  Text key_;                     // of the next value; empty in an array
};

void JsonTree::read_cbor() {
  // Values take two bytes and more, mostly; what is reserved in excess is never touched.
  constexpr std::size_t kMaxReserved = std::size_t{1} << 26;
  values_.reserve(std::min(text_.size() / 2 + 1, kMaxReserved));
  was_read_fast_ = CborEvents(text_, *this).parse_fast();
  if (was_read_fast_) return;
  values_.clear();
  CborEvents(text_, *this).parse();
}

}  // namespace graycube
