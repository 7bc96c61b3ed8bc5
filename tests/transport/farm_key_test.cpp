#include "transport/farm_key.hpp"

#include <stdlib.h>  // setenv; NOLINT(modernize-deprecated-headers)
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "catch.hpp"
#include "process/temporary_folder.hpp"
#include "transport/endpoint.hpp"

namespace graycube {
namespace {

mode_t mode_of(const std::string& path) {
  struct stat status {};
  REQUIRE(::lstat(path.c_str(), &status) == 0);
  return status.st_mode & 0777;
}

std::string problem_of(const std::string& file) {
  try {
    read_farm_key(file);
  } catch (const KeyError& e) {
    return e.what();
  }
  return "";
}

/// What a farm that begins does.
Secret make_key(const std::string& file) {
  const FoundKey found = find_farm_key(file);
  if (!found.is_in_file) write_farm_key(file, found.farm_key);
  return found.farm_key;
}

/// A folder for what running farms need, while it lives.
class RunFolder {
 public:
  RunFolder() { ::setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }
  ~RunFolder() { ::unsetenv("XDG_RUNTIME_DIR"); }
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

 private:
  TemporaryFolder folder_;
};

TEST_CASE("only TCP ports need a key, and one port has one file, however its host is written") {
  CHECK(needs_key("tcp://127.0.0.1:5555"));
  CHECK_FALSE(needs_key("ipc:///run/graycube/frontal"));
  CHECK(key_file_of("tcp://localhost:5555") == key_file_of("tcp://127.0.0.1:5555"));
  CHECK(key_file_of("tcp://127.0.0.1:5555") != key_file_of("tcp://127.0.0.1:5556"));
  CHECK(key_file_of("tcp://127.0.0.1:5555") != key_file_of("tcp://[::1]:5555"));
}

TEST_CASE("the key's file and folder are their owner's alone, whatever the umask") {
  const RunFolder run;
  const std::string file = key_file_of("tcp://127.0.0.1:5555");
  for (const mode_t mask : {mode_t{0}, mode_t{0777}}) {
    const mode_t before = ::umask(mask);
    const Secret key = make_key(file);
    ::umask(before);
    CHECK(read_farm_key(file) == key);
    CHECK(mode_of(file) == 0600);
    CHECK(mode_of(run_folder()) == 0700);
    ::unlink(file.c_str());
    ::rmdir(run_folder().c_str());
  }
}

TEST_CASE("a farm that begins again has the key that its clients know") {
  const RunFolder run;
  const std::string file = key_file_of("tcp://127.0.0.1:5555");
  const Secret key = make_key(file);
  CHECK(make_key(file) == key);
  ::unlink(file.c_str());
  CHECK(make_key(file) != key);
}

TEST_CASE("a key that others may read, or that is none, is refused with its file's name") {
  const TemporaryFolder folder;
  const std::string file = (folder / "key").string();
  CHECK(problem_of(file) == file + ": No such file or directory");
  std::ofstream(file) << "no key\n";
  REQUIRE(::chmod(file.c_str(), 0600) == 0);
  CHECK(problem_of(file) == file + ": expected a key of 64 hexadecimal digits");
  std::ofstream(file) << std::string(64, 'a') << '\n';
  CHECK(problem_of(file).empty());
  REQUIRE(::chmod(file.c_str(), 0640) == 0);
  CHECK(problem_of(file) == file + ": expected a file of this user that nobody else may read");
  CHECK(problem_of(folder.path().string()).ends_with("that nobody else may read"));
}

TEST_CASE("a client can do with a client's key what it can with the farm's, and nothing else") {
  const TemporaryFolder folder;
  const std::string of_farm = (folder / "farm").string(), of_client = (folder / "client").string();
  const Secret key = make_key(of_farm);
  const FarmKeys keys = farm_keys_of(key);
  std::ofstream(of_client) << text_of_client_key(client_keys_of(keys)) << '\n';
  REQUIRE(::chmod(of_client.c_str(), 0600) == 0);
  for (const std::string& file : {of_farm, of_client}) {
    const CurveAccess access = access_of_client(read_client_keys(file));
    CHECK(access.own.public_key == keys.clients.public_key);
    CHECK(access.own.secret_key == keys.clients.secret_key);
    CHECK(access.server == keys.door.public_key);
  }
  CHECK(problem_of(of_client) == of_client + ": it is a client's key, and a farm's is needed");
  const std::string text = text_of_client_key(client_keys_of(keys));
  for (const Secret& secret : {key, keys.node_secret, keys.nodes.secret_key, keys.door.secret_key})
    CHECK(text.find(hex_of(secret)) == std::string::npos);
  std::ofstream(of_client) << text.substr(1) << '\n';
  CHECK_THROWS_AS(read_client_keys(of_client), KeyError);
}

TEST_CASE("a folder that others may enter is no private one") {
  const TemporaryFolder folder;
  REQUIRE_NOTHROW(make_private_folder(folder.path().string()));
  REQUIRE(::chmod(folder.path().c_str(), 0750) == 0);
  CHECK_THROWS_AS(make_private_folder(folder.path().string()), KeyError);
}

}  // namespace
}  // namespace graycube
