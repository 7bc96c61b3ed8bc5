// graycube-meshes FILE: reads a file by the library assimp and writes its meshes to standard output
// (formats/mesh/part_stream.hpp). A process of its own, since the library isn't made for hostile
// files.
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <system_error>

#include "formats/mesh/assimp/read_assimp.hpp"
#include "formats/mesh/part_stream.hpp"

namespace graycube {
namespace {

/// What the library may take of the machine: bytes of address space, and seconds of CPU time, the
/// latter also for each MiB of the file. Some broken files of a few hundred bytes keep it busy for
/// ever.
constexpr rlim_t kMaxMemory = rlim_t{4} << 30, kMaxSeconds = 20, kMaxSecondsPerMib = 1;

rlim_t most_seconds(const char* path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return error ? kMaxSeconds : kMaxSeconds + kMaxSecondsPerMib * (size >> 20);
}

void limit(int resource, rlim_t most) {
  // The hard limit is later: it kills without saying why.
  const rlimit both{most, most + 1};
  ::setrlimit(resource, &both);
}

std::string meshes_as_bytes(const char* path) {
  try {
    const auto read = read_by_assimp(path);
    if (const auto* fault = std::get_if<MeshFault>(&read)) return encode_parts(*fault);
    return encode_parts(std::get<std::vector<MeshPart>>(read));
  } catch (const std::exception& e) {
    return encode_parts(MeshFault{std::string("its meshes take too much memory: ") + e.what()});
  }
}

int run(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: graycube-meshes FILE, as graycube calls it\n", stderr);
    return 2;
  }
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_AS, kMaxMemory);
  limit(RLIMIT_CPU, most_seconds(argv[1]));
  const std::string bytes = meshes_as_bytes(argv[1]);
  const bool is_written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
  return std::fflush(stdout) == 0 && is_written ? 0 : 1;
}

}  // namespace
}  // namespace graycube

int main(int argc, char** argv) { return graycube::run(argc, argv); }
