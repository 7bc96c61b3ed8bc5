// Compares what somebody shows with what he should know.
#pragma once

#include <string_view>

namespace graycube {

/// Whether two texts are the same. How long it takes to tell doesn't depend on where they differ,
/// so that nobody finds a secret out letter by letter.
[[nodiscard]] inline bool is_same_secret_text(std::string_view shown, std::string_view secret) {
  if (shown.size() != secret.size()) return false;
  unsigned differences = 0;
  for (std::size_t i = 0; i < secret.size(); ++i)
    differences |= static_cast<unsigned>(static_cast<unsigned char>(shown[i] ^ secret[i]));
  return differences == 0;
}

}  // namespace graycube
