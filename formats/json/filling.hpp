// Builds a JsonTree from the events of nlohmann's parsers, of JSON and of CBOR.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/json/tree.hpp"
#include "stop_point.hpp"

namespace graycube {

class JsonFilling {
 public:
  /// A string as found: a range of the text, or an index into the tree's decoded strings.
  struct Text {
    std::uint32_t begin = 0, length = 0;
    bool decoded = false;
  };

  explicit JsonFilling(JsonTree& tree) : tree_(tree) {}

  /// A value that begins at `begin`, with the key that was set, in the innermost open container.
  void add(JsonKind kind, std::size_t begin) { append(kind, begin); }
  void add_number(std::size_t begin, double number) {
    append(JsonKind::kNumber, begin).payload = std::bit_cast<std::uint64_t>(number);
  }
  void add_string(std::size_t begin, const Text& text) {
    JsonTree::Value& added = append(JsonKind::kString, begin);
    added.payload = std::uint64_t{text.begin} << 32 | text.length;
    added.string_is_decoded = text.decoded;
  }
  /// Adds an array or object; false when it is nested too deep, and then it isn't open.
  [[nodiscard]] bool open(JsonKind kind, std::size_t begin) {
    const auto self = static_cast<JsonIndex>(tree_.values_.size());
    append(kind, begin);
    if (open_.size() >= kMaxJsonNesting) return false;
    open_.push_back(self);
    return true;
  }
  void close() {
    tree_.values_[open_.back()].next = static_cast<JsonIndex>(tree_.values_.size());
    open_.pop_back();
  }
  void close_all() {
    while (!open_.empty()) close();
  }
  bool has_open() const { return !open_.empty(); }

  /// Keeps a string of at most kMaxJsonString bytes: as a range of the text when the text has it at
  /// `begin` as it is, else as a copy.
  Text keep(std::string_view string, bool is_as_it_is, std::size_t begin) {
    if (!is_as_it_is) {
      begin = tree_.decoded_.size();
      tree_.decoded_.emplace_back(string);
    }
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(string.size()),
            !is_as_it_is};
  }
  /// Sets the key of the next value.
  void set_key(const Text& key) { key_ = key; }

  /// Keeps the error; always false.
  bool fail(std::size_t at, std::string message) {
    const std::size_t count = tree_.values_.size();
    tree_.syntax_error_ = {at, static_cast<JsonIndex>(count == 0 ? 0 : count - 1),
                           std::move(message)};
    return false;
  }

 private:
  JsonTree::Value& append(JsonKind kind, std::size_t begin) {
    const auto self = static_cast<JsonIndex>(tree_.values_.size());
    if (self % kValuesBetweenStops == 0) stop_if_asked();
    if (!open_.empty()) ++tree_.values_[open_.back()].payload;
    JsonTree::Value& value = tree_.values_.emplace_back();
    value.kind = kind;
    value.begin = static_cast<std::uint32_t>(begin);
    value.next = self + 1;
    value.key_begin = key_.begin;
    value.key_length = static_cast<std::uint16_t>(key_.length);
    value.key_is_decoded = key_.decoded;
    key_ = {};
    return value;
  }

  JsonTree& tree_;
  std::vector<JsonIndex> open_;  // containers around the next value, outermost first
  Text key_;                     // of the next value; empty in an array
};

}  // namespace graycube
