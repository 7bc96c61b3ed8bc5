// A text that vector instructions may read past the end of.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace graycube {

/// Number of zero bytes behind the text: readable and owned by it, but no part of it.
inline constexpr std::size_t kTextPadding = 64;

/// Owns a text and its padding. To read a file into a string, reserve kTextPadding more than its
/// size: then nothing is copied, on the way in or out.
class PaddedText {
 public:
  explicit PaddedText(std::string text) : bytes_(std::move(text)) {
    bytes_.append(kTextPadding, '\0');
  }
  /// Copies the text.
  explicit PaddedText(std::string_view text) {
    bytes_.reserve(text.size() + kTextPadding);
    bytes_.append(text).append(kTextPadding, '\0');
  }

  std::string_view view() const { return {bytes_.data(), bytes_.size() - kTextPadding}; }
  /// The text alone, without its padding.
  std::string take() && {
    bytes_.resize(bytes_.size() - kTextPadding);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

}  // namespace graycube
