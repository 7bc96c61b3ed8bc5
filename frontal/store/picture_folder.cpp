#include "frontal/store/picture_folder.hpp"

#include <system_error>
#include <utility>

#include "film/picture_files.hpp"
#include "frontal/store/durable_file.hpp"
#include "frontal/store/job_files.hpp"
#include "version.hpp"

namespace graycube {

namespace fs = std::filesystem;

PictureFolder::PictureFolder(fs::path folder, bool is_durable, Warn warn)
    : folder_(std::move(folder)), is_durable_(is_durable), warn_(std::move(warn)) {}

fs::path PictureFolder::file(std::uint32_t job) const { return job_file(folder_, job, ".exr"); }

void PictureFolder::write(std::uint32_t job, const Picture& picture,
                          const std::string& scene) const {
  const fs::path unfinished = job_file(folder_, job, ".exr.part");
  write_exr(unfinished, picture, {scene, kVersion});
  put_in_place(unfinished, file(job), is_durable_);
}

void PictureFolder::hold(std::uint32_t job, Picture picture) {
  held_job_ = job;
  held_ = std::move(picture);
}

bool PictureFolder::is_there(std::uint32_t job) const {
  std::error_code error;
  return fs::exists(file(job), error);
}

std::optional<Picture> PictureFolder::read(std::uint32_t job) const {
  if (!is_there(job)) return std::nullopt;
  try {
    return read_exr(file(job));
  } catch (const PictureError& e) {
    set_aside(folder_, file(job), e.what(), warn_);
    return std::nullopt;
  }
}

void PictureFolder::remove(std::uint32_t job) noexcept {
  std::error_code ignored;
  fs::remove(file(job), ignored);
  if (job == held_job_) held_job_ = 0;
}

}  // namespace graycube
