#include "transport/farm_key.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>

#include "transport/endpoint.hpp"
#include "transport/secret.hpp"

namespace graycube {
namespace {

constexpr std::string_view kTcp = "tcp://";

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

bool exists(const std::string& path) { return ::access(path.c_str(), F_OK) == 0; }

void write_key(const std::string& file, const std::string& key) {
  // A client finds the file whole or not at all.
  const std::string unfinished = file + "." + std::to_string(::getpid());
  {
    const File out(unfinished, O_WRONLY | O_CREAT | O_EXCL);
    const std::string line = key + '\n';
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

std::string read_key(const std::string& file) {
  const File in(file, O_RDONLY | O_NONBLOCK);
  if (!in.is_open()) throw error_of(file);
  struct stat status {};
  if (::fstat(in.descriptor(), &status) != 0) throw error_of(file);
  if (!S_ISREG(status.st_mode) || status.st_uid != ::geteuid() || (status.st_mode & 0077) != 0)
    throw KeyError(file + ": expected a file of this user that nobody else may read");
  std::array<char, 128> text{};
  const ssize_t got = ::read(in.descriptor(), text.data(), text.size());
  if (got < 0) throw error_of(file);
  std::string_view key(text.data(), static_cast<std::size_t>(got));
  if (key.ends_with('\n')) key.remove_suffix(1);
  if (!secret_of_hex(key)) throw KeyError(file + ": expected a key of 64 hexadecimal digits");
  return std::string(key);
}

std::string make_key(const std::string& file) {
  if (file.starts_with(run_folder() + "/")) make_private_folder(run_folder());
  if (exists(file)) return read_key(file);
  std::string key = hex_of(make_secret());
  write_key(file, key);
  return key;
}

}  // namespace graycube
