#include "cli/farm/job_client.hpp"

#include <algorithm>
#include <filesystem>
#include <random>
#include <span>

#include "proto/control.hpp"
#include "proto/picture_rows.hpp"
#include "shading/settings.hpp"

namespace graycube {
namespace {

/// After so long without a message, the frontal is asked whether it is still there.
constexpr std::chrono::seconds kQuiet{2};

/// 128 random bits, as digits.
std::string random_key() {
  std::random_device random;
  std::string key;
  for (int i = 0; i < 4; ++i) {
    for (std::uint32_t bits = random(), digits = 0; digits < 8; bits >>= 4, ++digits)
      key += "0123456789abcdef"[bits & 15];
  }
  return key;
}

Failure nonsense(std::uint32_t job) {
  return {ExitStatus::kFailed,
          Problem{"fetch", "job " + std::to_string(job), "the frontal sent no proper picture"}};
}

bool is_sound(const control::Picture& rows, const Picture& picture, std::uint32_t first,
              std::uint32_t plane) {
  const bool is_size_possible = rows.width >= 1 && rows.width <= kMaxImageSide &&
                                rows.height >= 1 && rows.height <= kMaxImageSide &&
                                std::uint64_t{rows.width} * rows.height <= kMaxPixels;
  const bool is_size_same =
      (first == 0 && plane == 0) || (rows.width == picture.width && rows.height == picture.height);
  return is_size_possible && is_size_same && rows.plane == plane && rows.first_row == first &&
         rows.rows >= 1 && rows.rows <= rows.height - first;
}

/// Fetches all rows of light (plane 0) or of a plane of AOVs, and puts each in its place. The
/// picture's size and AOVs come with the light.
template <typename Value>
void fetch_plane(FarmClient& farm, std::uint32_t job, std::uint32_t plane, Picture& picture,
                 std::vector<Value>& all) {
  std::uint32_t row = 0;
  do {
    const control::Fetch request{job, row,
                                 picture.height == 0 ? kMaxImageSide : picture.height - row, plane};
    const auto [rows, payload] = farm.ask<control::Picture>(request, "fetch");
    const auto aovs = parse_aovs(rows.aov);
    if (!is_sound(rows, picture, row, plane) || !aovs) throw nonsense(job);
    if (plane == 0) {
      picture.width = rows.width;
      picture.height = rows.height;
      picture.aovs = *aovs;
    }
    const std::size_t row_values = std::size_t{3} * rows.width;
    all.resize(row_values * rows.height);
    if (!decode_picture_rows(payload.bytes(),
                             std::span(all).subspan(row * row_values, rows.rows * row_values))) {
      throw nonsense(job);
    }
    row += rows.rows;
  } while (row < picture.height);
}

}  // namespace

Bytes bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  return Bytes(bytes.begin(), bytes.end());
}

std::uint32_t submit_scene(FarmClient& farm, const std::string& name, SharedBytes scene,
                           const control::JobOptions& options) {
  // Random, so that nobody else's job is taken for this one.
  const control::Submit request{name, options, random_key()};
  return farm.ask<control::Accepted>(request, "submit", std::move(scene)).first.job;
}

std::uint32_t submit_scene(FarmClient& farm, const SceneInput& scene,
                           const control::JobOptions& options) {
  return submit_scene(farm, scene.name, bytes_of(scene.text), options);
}

std::string follow_job(FarmClient& farm, std::uint32_t job, ProgressDisplay& display) {
  farm.send(control::Watch{job});
  auto heard = FarmClient::Clock::now();
  for (;;) {
    const auto received = farm.receive(kQuiet);
    if (!received) {
      if (FarmClient::Clock::now() - heard > kLaterAnswer) throw farm.silence();
      farm.send(control::Watch{job});
      continue;
    }
    heard = FarmClient::Clock::now();
    const ControlMessage& m = received->message;
    if (const auto* progress = std::get_if<control::Progress>(&m)) {
      if (progress->job == job) display.show(*progress);
    } else if (const auto* done = std::get_if<control::Done>(&m)) {
      if (done->job == job) return done->stats.text;
    } else if (const auto* failed = std::get_if<control::Failed>(&m)) {
      throw failure_of(*failed, failed->code == FailureCode::kBadInput ? "scene" : "render");
    } else if (std::holds_alternative<control::Bye>(m)) {
      throw Failure(ExitStatus::kFailed, Problem{"render", "farm", "it has stopped"});
    }
  }
}

control::JobInfo job_info(FarmClient& farm, std::uint32_t job) {
  return farm.ask<control::JobInfo>(control::Status{job}, "job").first;
}

std::optional<control::Written> have_picture_written(FarmClient& farm, std::uint32_t job,
                                                     const Outputs& outputs,
                                                     const ImageSize& size) {
  const auto absolute = [](const std::filesystem::path& path) {
    return path.empty() ? std::string() : std::filesystem::absolute(path).string();
  };
  const control::Write request{job, absolute(outputs.exr), absolute(outputs.png)};
  // Texts in messages are cut if they are too long, and mended if they aren't UTF-8.
  const auto arriving = decode(encode(request));
  const auto* message = std::get_if<ControlMessage>(&arriving);
  if (message == nullptr || *message != ControlMessage(request)) return std::nullopt;
  if (std::uint64_t{size.width} * size.height > kMostPixelsToWrite) return std::nullopt;
  return farm.ask<control::Written>(request, "output").first;
}

Picture fetch_picture(FarmClient& farm, std::uint32_t job) {
  Picture picture;
  fetch_plane(farm, job, 0, picture, picture.rgb);
  for (std::uint32_t plane = 1; plane <= kAovPlanes; ++plane) {
    if (!has_plane(picture.aovs, plane - 1)) continue;
    fetch_plane(farm, job, plane, picture, picture.aov_planes[plane - 1]);
  }
  return picture;
}

std::string summary_text(const control::JobInfo& info) {
  std::string text(to_string(info.algorithm));
  text += " on " + std::to_string(info.nodes) + (info.nodes == 1 ? " node" : " nodes");
  if (!info.choices.empty()) text += ", " + info.choices;
  if (info.rounds > 0) text += ", " + end_checks_text(info.rounds);
  return text;
}

}  // namespace graycube
