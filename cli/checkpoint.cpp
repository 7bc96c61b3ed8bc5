#include "cli/checkpoint.hpp"

#include <fstream>
#include <system_error>
#include <utility>

#include "cli/failure.hpp"
#include "content_digest.hpp"
#include "proto/control.hpp"
#include "proto/job_settings.hpp"
#include "proto/model_slice.hpp"
#include "version.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kWriteInterval{200};

/// The options that change the picture, and no others.
control::JobOptions options_of_picture(const control::JobOptions& options) {
  control::JobOptions kept;
  kept.width = options.width;
  kept.height = options.height;
  kept.samples = options.samples;
  kept.max_depth = options.max_depth;
  kept.aov = options.aov;
  return kept;
}

std::vector<std::byte> bytes_in(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return {};
  std::vector<std::byte> bytes(size);
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (in.gcount() != static_cast<std::streamsize>(size)) {
    throw Failure(ExitStatus::kBadInput, Problem{"--checkpoint", file.string(), "can't be read"});
  }
  return bytes;
}

}  // namespace

RecordedPicture picture_of(const SceneInput& scene, const control::JobOptions& options) {
  ContentDigest content;
  content.add(encode(control::Submit{"", options_of_picture(options), ""})).add(kVersion);
  const Model model = compile_input(scene);
  if (fits_model_limits(model)) {
    content.add(encode_model(model));
  } else {
    content.add(scene.text);
  }
  RenderSettings settings = scene.scene.settings;
  apply_overrides(options, settings);
  return {content.value(), settings.image.width, settings.image.height, settings.aovs};
}

Checkpoint::Checkpoint(fs::path file, const RecordedPicture& picture)
    : file_(fs::absolute(std::move(file))), picture_(picture) {
  std::error_code error;
  if (!fs::exists(file_, error) || fs::file_size(file_, error) == 0) return;
  std::vector<std::byte> head(kRecordsHeadBytes);
  std::ifstream in(file_, std::ios::binary);
  in.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  const auto found = decode_records_head(head);
  if (found == picture_) return;
  throw Failure(ExitStatus::kBadInput,
                Problem{"--checkpoint", file_.string(),
                        found ? "it is of another scene, of options that make another picture, or "
                                "of another version; remove it to begin anew"
                              : "it is no checkpoint"});
}

void Checkpoint::restore(Film& film) { known_ = restore_tiles(bytes_in(file_), film); }

bool Checkpoint::is_wanted(const PixelRect& tile) const {
  for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
    for (std::uint32_t x = tile.x0; x < tile.x1; ++x) {
      if (!known_[std::size_t{y} * picture_.width + x]) return true;
    }
  }
  ++resumed_;
  return false;
}

void Checkpoint::note(const PixelRect& tile) {
  const std::lock_guard lock(mutex_);
  whole_.push_back(tile);
}

void Checkpoint::write(const Film& film, bool now) {
  if (!now && std::chrono::steady_clock::now() - written_at_ < kWriteInterval) return;
  std::vector<PixelRect> whole;
  {
    const std::lock_guard lock(mutex_);
    whole.swap(whole_);
  }
  written_at_ = std::chrono::steady_clock::now();
  if (whole.empty()) return;
  std::error_code error;
  const bool is_new = !fs::exists(file_, error) || fs::file_size(file_, error) == 0;
  auto bytes = is_new ? encode_records_head(picture_) : std::vector<std::byte>();
  for (const PixelRect& tile : whole) append_tile_record(bytes, film, tile);
  std::ofstream out(file_, std::ios::binary | std::ios::app);
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) {
    throw Failure(ExitStatus::kFailed, Problem{"--checkpoint", file_.string(), "can't be written"});
  }
}

void Checkpoint::remove() noexcept {
  std::error_code ignored;
  fs::remove(file_, ignored);
}

void Checkpoint::print_hint() const {
  std::error_code error;
  if (!fs::exists(file_, error)) return;
  print({"render", file_.string(), "what is done is kept there; the same command goes on from it"});
}

}  // namespace graycube
