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

void PictureFolder::keep(std::uint32_t job, Picture picture, const std::string& scene) {
  const fs::path unfinished = job_file(folder_, job, ".exr.part");
  write_exr(unfinished, picture, {scene, kVersion});
  put_in_place(unfinished, file(job), is_durable_);
  last_job_ = job;
  last_ = std::move(picture);
}

const Picture* PictureFolder::find(std::uint32_t job) {
  if (job == last_job_) return &last_;
  std::error_code error;
  if (!fs::exists(file(job), error)) return nullptr;
  try {
    last_ = read_exr(file(job));
    last_job_ = job;
    return &last_;
  } catch (const PictureError& e) {
    last_job_ = 0;
    set_aside(folder_, file(job), e.what(), warn_);
    return nullptr;
  }
}

void PictureFolder::remove(std::uint32_t job) noexcept {
  std::error_code ignored;
  fs::remove(file(job), ignored);
  if (job == last_job_) last_job_ = 0;
}

}  // namespace graycube
