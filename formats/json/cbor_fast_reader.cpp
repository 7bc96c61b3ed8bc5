#include "formats/json/cbor_fast_reader.hpp"

#include <bit>
#include <cmath>

#include "stop_point.hpp"

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

template <int kBytes>
std::uint64_t big_endian(const char* at) {
  std::uint64_t v = 0;
  for (int i = 0; i < kBytes; ++i) v = v << 8 | static_cast<std::uint8_t>(at[i]);
  return v;
}

}  // namespace

FastCborReader::FastCborReader(JsonTree& tree)
    : tree_(tree),
      begin_(tree.text_.data()),
      at_(begin_ + kCborMagic.size()),
      end_(begin_ + tree.text_.size()) {}

bool FastCborReader::read_whole() { return read_value({}) && is_at_end(); }

bool FastCborReader::read_up_to(std::string_view last) {
  Head head;
  if (!read_head(at_, end_, head) || head.major != kMap || head.argument == 0) return false;
  add(JsonKind::kObject, at_, head.argument, {});
  outer_levels_ = 1;
  Key key;
  for (std::uint64_t left = head.argument; left > 0; --left) {
    if (!read_key(key) || (left > 1 && !read_value(key))) return false;
  }
  if (std::string_view(begin_ + key.begin, key.length) != last) return false;
  if (!read_head(at_, end_, head) || head.major != kArray || head.argument > 0xFFFFFFFFu)
    return false;
  add(JsonKind::kArray, at_, head.argument, key);
  outer_levels_ = 2;
  kept_values_ = tree_.values_.size();
  tree_.values_.front().next = static_cast<JsonIndex>(kept_values_);
  return true;
}

bool FastCborReader::read_element(JsonIndex& at) {
  dropped_values_ += tree_.values_.size() - kept_values_;
  tree_.values_.resize(kept_values_);
  at = static_cast<JsonIndex>(kept_values_);
  return read_value({}) && dropped_values_ + tree_.values_.size() < kMaxCborValues;
}

/// Reads one value with all below it.
bool FastCborReader::read_value(Key key) {
  auto& values = tree_.values_;
  const char* at = at_;
  const char* const end = end_;
  levels_.clear();
  // The value is treated as the only element of an array that isn't there.
  for (Level level{0, false, 1};;) {
    while (level.left == 0) {
      if (levels_.empty()) {
        at_ = at;
        return true;
      }
      values[level.self].next = static_cast<JsonIndex>(values.size());
      level = levels_.back();
      levels_.pop_back();
    }
    Head head;
    if (values.size() >= kMaxJsonValues || !read_head(at, end, head)) return false;
    const bool wants_key = level.is_map && key.begin == 0;
    if (head.major == kText) {
      const char* const text = at;
      if (!skip_text(at, end, head)) return false;
      if (wants_key) {
        key = {offset(text), static_cast<std::uint16_t>(head.argument)};
        continue;
      }
      add(JsonKind::kString, at, std::uint64_t{offset(text)} << 32 | head.argument, key);
    } else if (wants_key) {
      return false;
    } else if (head.major == kArray || head.major == kMap) {
      const bool is_map = head.major == kMap;
      if (outer_levels_ + levels_.size() >= kMaxJsonNesting) return false;
      --level.left;
      levels_.push_back(level);
      level = {add(is_map ? JsonKind::kObject : JsonKind::kArray, at, head.argument, key), is_map,
               head.argument};
      key = {};
      continue;
    } else {
      JsonKind kind = JsonKind::kNumber;
      std::uint64_t payload = 0;
      if (!scalar_of(head, kind, payload)) return false;
      add(kind, at, payload, key);
    }
    key = {};
    --level.left;
  }
}

bool FastCborReader::read_key(Key& key) {
  Head head;
  if (!read_head(at_, end_, head) || head.major != kText) return false;
  key = {offset(at_), static_cast<std::uint16_t>(head.argument)};
  return skip_text(at_, end_, head);
}

inline bool FastCborReader::read_head(const char*& at, const char* end, Head& head) {
  if (at == end) return false;
  const auto first = static_cast<std::uint8_t>(*at++);
  head = {static_cast<std::uint8_t>(first >> 5), static_cast<std::uint8_t>(first & 31),
          first & 31u};
  if (head.info < 24) return true;
  if (head.info > 27) return false;
  const int count = 1 << (head.info - 24);
  if (end - at < count) return false;
  switch (count) {
    case 1: head.argument = big_endian<1>(at); break;
    case 2: head.argument = big_endian<2>(at); break;
    case 4: head.argument = big_endian<4>(at); break;
    default: head.argument = big_endian<8>(at);
  }
  at += count;
  return true;
}

inline bool FastCborReader::skip_text(const char*& at, const char* end, const Head& head) {
  if (head.argument > kMaxJsonString || static_cast<std::size_t>(end - at) < head.argument)
    return false;
  at += head.argument;
  return true;
}

inline bool FastCborReader::scalar_of(const Head& head, JsonKind& kind, std::uint64_t& payload) {
  double number = 0;
  if (head.major == kSimple && head.info == 27) {
    number = std::bit_cast<double>(head.argument);
  } else if (head.major == kSimple && head.info == 26) {
    number = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(head.argument)));
  } else if (head.major == kUnsigned) {
    number = static_cast<double>(head.argument);
  } else if (head.major == kNegative && head.argument >> 63 == 0) {
    number = static_cast<double>(-1 - static_cast<std::int64_t>(head.argument));
  } else if (head.major == kSimple && head.info >= 20 && head.info <= 22) {
    kind = head.info == 20 ? JsonKind::kFalse : head.info == 21 ? JsonKind::kTrue : JsonKind::kNull;
    return true;
  } else {
    return false;
  }
  payload = std::bit_cast<std::uint64_t>(number);
  return std::isfinite(number);
}

inline JsonIndex FastCborReader::add(JsonKind kind, const char* at, std::uint64_t payload,
                                     const Key& key) {
  const auto self = static_cast<JsonIndex>(tree_.values_.size());
  if (self % kValuesBetweenStops == 0) stop_if_asked();
  tree_.values_.push_back(
      {payload, offset(at), self + 1, key.begin, key.length, kind, false, false});
  return self;
}

}  // namespace graycube
