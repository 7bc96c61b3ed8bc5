#include "transport/farm_key.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "transport/endpoint.hpp"

namespace graycube {
namespace {

constexpr std::string_view kTcp = "tcp://";
/// What a client's key begins with; two keys follow, in hexadecimal digits.
constexpr std::string_view kClientKey = "client-";
constexpr std::size_t kDigits = 64;

KeyError error_of(const std::string& path) { return KeyError(path + ": " + std::strerror(errno)); }

class File {
 public:
  File(const std::string& path, int flags)
      : descriptor_(::open(path.c_str(), flags | O_CLOEXEC, 0600)) {}
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// The line that the file says, with no end.
std::string key_text(const std::string& file) {
  const File in(file, O_RDONLY | O_NONBLOCK);
  if (!in.is_open()) throw error_of(file);
  struct stat status {};
  if (::fstat(in.descriptor(), &status) != 0) throw error_of(file);
  if (!S_ISREG(status.st_mode) || status.st_uid != ::geteuid() || (status.st_mode & 0077) != 0)
    throw KeyError(file + ": expected a file of this user that nobody else may read");
  std::array<char, 256> text{};
  const ssize_t got = ::read(in.descriptor(), text.data(), text.size());
  if (got < 0) throw error_of(file);
  std::string key(text.data(), static_cast<std::size_t>(got));
  if (key.ends_with('\n')) key.pop_back();
  return key;
}

std::optional<ClientKeys> client_keys_in(std::string_view text) {
  if (!text.starts_with(kClientKey)) return std::nullopt;
  text.remove_prefix(kClientKey.size());
  if (text.size() != 2 * kDigits) return std::nullopt;
  const auto own = secret_of_hex(text.substr(0, kDigits)),
             door = secret_of_hex(text.substr(kDigits));
  if (!own || !door) return std::nullopt;
  return ClientKeys{*own, *door};
}

}  // namespace

bool needs_key(const std::string& endpoint) { return endpoint.starts_with(kTcp); }

std::string key_file_of(const std::string& endpoint) {
  const std::string address = endpoint.substr(kTcp.size());
  const std::size_t colon = address.rfind(':');
  std::string host = address.substr(0, colon);
  if (host == "localhost") host = "127.0.0.1";
  return run_folder() + "/key-" + host + "-" + address.substr(colon + 1);
}

void make_private_folder(const std::string& folder) {
  const bool is_new = ::mkdir(folder.c_str(), 0700) == 0;
  if (!is_new && errno != EEXIST) throw error_of(folder);
  // The umask may have taken rights that the owner needs.
  if (is_new && ::chmod(folder.c_str(), 0700) != 0) throw error_of(folder);
  struct stat status {};
  if (::lstat(folder.c_str(), &status) != 0) throw error_of(folder);
  if (!S_ISDIR(status.st_mode) || status.st_uid != ::geteuid() || (status.st_mode & 0077) != 0)
    throw KeyError(folder + ": expected a folder of this user that nobody else may enter");
}

std::string text_of_farm_key(const Secret& farm_key) { return hex_of(farm_key); }

std::string text_of_client_key(const ClientKeys& keys) {
  return std::string(kClientKey) + hex_of(keys.client_secret) + hex_of(keys.door_public);
}

Secret read_farm_key(const std::string& file) {
  const std::string text = key_text(file);
  if (const auto key = secret_of_hex(text)) return *key;
  throw KeyError(file + (client_keys_in(text) ? ": it is a client's key, and a farm's is needed"
                                              : ": expected a key of 64 hexadecimal digits"));
}

ClientKeys read_client_keys(const std::string& file) {
  const std::string text = key_text(file);
  if (const auto key = secret_of_hex(text)) return client_keys_of(farm_keys_of(*key));
  if (const auto keys = client_keys_in(text)) return *keys;
  throw KeyError(file + ": expected a key, as 'graycube key' prints it");
}

FoundKey find_farm_key(const std::string& file) {
  if (::access(file.c_str(), F_OK) == 0) return {read_farm_key(file), true};
  return {make_secret(), false};
}

void write_farm_key(const std::string& file, const Secret& farm_key) {
  if (file.starts_with(run_folder() + "/")) make_private_folder(run_folder());
  // A client finds the file whole or not at all.
  const std::string unfinished = file + "." + std::to_string(::getpid());
  {
    const File out(unfinished, O_WRONLY | O_CREAT | O_EXCL);
    const std::string line = text_of_farm_key(farm_key) + '\n';
    if (!out.is_open()) throw error_of(unfinished);
    // Whatever the umask is, the owner may read it.
    const bool is_written =
        ::fchmod(out.descriptor(), 0600) == 0 &&
        ::write(out.descriptor(), line.data(), line.size()) == static_cast<ssize_t>(line.size());
    if (is_written && ::rename(unfinished.c_str(), file.c_str()) == 0) return;
  }
  const KeyError error = error_of(file);
  ::unlink(unfinished.c_str());
  throw error;
}

}  // namespace graycube
