// What a farm's own processes know and nobody else does: 32 random bytes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace graycube {

/// So many who don't show a farm's secret are told of on standard error; further ones are only
/// dropped.
inline constexpr unsigned kMaxStrangersTold = 8;

using Secret = std::array<std::byte, 32>;

/// Where a farm's nodes find its secret when they are started: not on their command line nor in
/// their environment, which other processes may see.
inline constexpr int kSecretDescriptor = 3;

/// Random bytes from the system. Throws std::system_error when it has none.
Secret make_secret();

/// Whether `told` is the secret. How long it takes to tell doesn't depend on where they differ.
[[nodiscard]] inline bool is_same_secret(std::span<const std::byte> told, const Secret& secret) {
  if (told.size() != secret.size()) return false;
  std::byte differences{0};
  for (std::size_t i = 0; i < secret.size(); ++i) differences |= told[i] ^ secret[i];
  return differences == std::byte{0};
}

/// A secret as 64 hexadecimal digits, and back; nothing for any other text.
std::string hex_of(const Secret& secret);
std::optional<Secret> secret_of_hex(std::string_view text);

/// An unnamed file that holds the secret, to be passed to a child. The caller closes it. Throws
/// std::system_error.
int make_secret_file(const Secret& secret);

/// Reads the secret from such a file and closes it. Nothing when the descriptor holds none.
std::optional<Secret> take_secret(int descriptor);

}  // namespace graycube
