#include "transport/secret.hpp"

#include <sys/mman.h>
#include <sys/random.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace graycube {
namespace {

constexpr std::string_view kDigits = "0123456789abcdef";

}  // namespace

Secret make_secret() {
  Secret secret;
  // Up to 256 bytes come whole, whatever signals arrive.
  if (::getrandom(secret.data(), secret.size(), 0) != static_cast<ssize_t>(secret.size()))
    throw std::system_error(errno, std::generic_category(), "getrandom");
  return secret;
}

std::string hex_of(const Secret& secret) {
  std::string text;
  for (const std::byte b : secret) {
    text += kDigits[std::to_integer<unsigned>(b) >> 4];
    text += kDigits[std::to_integer<unsigned>(b) & 15U];
  }
  return text;
}

std::optional<Secret> secret_of_hex(std::string_view text) {
  Secret secret;
  if (text.size() != 2 * secret.size()) return std::nullopt;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    const std::size_t high = kDigits.find(text[2 * i]), low = kDigits.find(text[2 * i + 1]);
    if (high == kDigits.npos || low == kDigits.npos) return std::nullopt;
    secret[i] = static_cast<std::byte>(16 * high + low);
  }
  return secret;
}

int make_secret_file(const Secret& secret) {
  const int file = ::memfd_create("graycube-secret", MFD_CLOEXEC);
  if (file < 0) throw std::system_error(errno, std::generic_category(), "memfd_create");
  if (::pwrite(file, secret.data(), secret.size(), 0) != static_cast<ssize_t>(secret.size())) {
    const int error = errno;
    ::close(file);
    throw std::system_error(error, std::generic_category(), "memfd_create");
  }
  return file;
}

std::optional<Secret> take_secret(int descriptor) {
  Secret secret;
  const ssize_t got = ::pread(descriptor, secret.data(), secret.size(), 0);
  if (got >= 0) ::close(descriptor);
  if (got != static_cast<ssize_t>(secret.size())) return std::nullopt;
  return secret;
}

}  // namespace graycube
