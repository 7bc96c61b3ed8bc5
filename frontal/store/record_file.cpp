#include "frontal/store/record_file.hpp"

#include <algorithm>
#include <fstream>
#include <system_error>

namespace graycube {

namespace fs = std::filesystem;

Bytes read_record_file(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size > kMaxRecordFileBytes) return {};
  Bytes bytes(size);
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return bytes;
}

}  // namespace graycube
