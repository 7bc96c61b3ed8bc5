// graycube-meshes FILE: reads a file by the library assimp and writes its meshes to standard output
// (formats/mesh/part_stream.hpp). A process of its own, since the library isn't made for hostile
// files.
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <string>

#include "formats/mesh/assimp/read_assimp.hpp"
#include "formats/mesh/part_stream.hpp"

namespace graycube {
namespace {

/// What the library may take of the machine: bytes of address space, and seconds of CPU time.
constexpr rlim_t kMaxMemory = rlim_t{4} << 30, kMaxSeconds = 300;

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
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
  limit(RLIMIT_CPU, kMaxSeconds);
  const std::string bytes = meshes_as_bytes(argv[1]);
  const bool is_written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
  return std::fflush(stdout) == 0 && is_written ? 0 : 1;
}

}  // namespace
}  // namespace graycube

int main(int argc, char** argv) { return graycube::run(argc, argv); }
