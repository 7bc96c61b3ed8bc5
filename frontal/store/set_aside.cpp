#include "frontal/store/set_aside.hpp"

#include <exception>
#include <system_error>

namespace graycube {
namespace {

namespace fs = std::filesystem;

/// Names that are tried for a file whose own is taken.
constexpr int kMaxNames = 1000;

fs::path free_name(const fs::path& folder, const fs::path& name) {
  fs::path free = folder / name;
  for (int i = 2; fs::exists(free) && i <= kMaxNames; ++i)
    free = folder / (name.string() + "." + std::to_string(i));
  return free;
}

}  // namespace

void set_aside(const fs::path& folder, const fs::path& file, const std::string& why,
               const Warn& warn) noexcept {
  try {
    const fs::path damaged = folder / kDamagedFolder;
    fs::create_directories(damaged);
    const fs::path place = free_name(damaged, file.filename());
    fs::rename(file, place);
    warn(file.string() + " is damaged (" + why + "); it lies in " + place.string() + " now");
  } catch (const std::exception& e) {
    warn(file.string() + " is damaged (" + why + "), and can't be set aside: " + e.what());
  }
}

}  // namespace graycube
