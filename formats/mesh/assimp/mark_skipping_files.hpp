// Opens files for assimp.
#pragma once

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>

#include <array>
#include <cstdint>
#include <memory>

namespace graycube {

/// Files without the byte order mark of UTF-8 at their start, which the library takes for a part of
/// the first word in some formats; and without those that are too large, also beside the first.
class MarkSkippingFiles : public Assimp::DefaultIOSystem {
 public:
  explicit MarkSkippingFiles(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    constexpr std::array<unsigned char, 3> kMark{0xEF, 0xBB, 0xBF};
    std::unique_ptr<Assimp::IOStream> stream(DefaultIOSystem::Open(file, mode));
    if (!stream || stream->FileSize() > most_bytes_) return nullptr;
    std::array<unsigned char, 3> head{};
    const bool has_mark = stream->Read(head.data(), 1, head.size()) == head.size() && head == kMark;
    if (!has_mark) {
      stream->Seek(0, aiOrigin_SET);
      return stream.release();
    }
    const std::size_t size = stream->FileSize() - kMark.size();
    auto bytes = std::make_unique<std::uint8_t[]>(size);
    if (stream->Read(bytes.get(), 1, size) != size) return nullptr;
    return new Assimp::MemoryIOStream(bytes.release(), size, true);
  }

 private:
  std::size_t most_bytes_;
};

}  // namespace graycube
