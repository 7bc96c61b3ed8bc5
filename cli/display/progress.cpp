#include "cli/display/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "proto/control.hpp"

namespace graycube {
namespace {

constexpr std::chrono::milliseconds kRedrawInterval{50};
constexpr std::chrono::seconds kLineInterval{1};
constexpr std::size_t kDefaultColumns = 80;
constexpr std::size_t kMinBar = 5, kMaxBar = 30;

std::string percent(double fraction) {
  // Rounded down, so that 100 % is shown only when all is complete.
  const double p = std::floor(100 * std::clamp(fraction, 0.0, 1.0) + 1e-9);
  return std::to_string(static_cast<int>(p)) + " %";
}

bool is_rendering(const control::Progress& p) { return p.state == JobState::kRendering; }

std::string time_left(const control::Progress& p) {
  return p.eta_s && p.fraction < 1 ? ", " + duration_text(*p.eta_s) + " left" : "";
}

/// The text behind the percentage on a line of its own.
std::string details(const control::Progress& p) {
  std::string text = time_left(p);
  if (p.tiles > 0) text += ", " + final_parts_text(p.tiles_whole, p.tiles);
  if (p.rounds > 0) text += ", " + end_checks_text(p.rounds);
  return text;
}

/// Nearly the same for the text behind a bar, short enough for a terminal of 80 columns.
std::string short_details(const control::Progress& p) {
  std::string text = time_left(p);
  if (p.tiles > 0) {
    text +=
        ", " + std::to_string(p.tiles_whole) + " of " + std::to_string(p.tiles) + " parts final";
  }
  if (p.rounds > 0) {
    text += ", " + std::to_string(p.rounds) + (p.rounds == 1 ? " end check" : " end checks");
  }
  return text;
}

std::size_t terminal_columns(std::FILE* stream) {
  winsize size{};
  if (::ioctl(::fileno(stream), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kDefaultColumns;
  return size.ws_col;
}

}  // namespace

std::string duration_text(double seconds) {
  const double s = std::max(0.0, seconds);
  if (s < 0.9995) return std::to_string(static_cast<int>(std::round(1000 * s))) + " ms";
  if (s < 9.95) {
    const auto tenths = static_cast<int>(std::round(10 * s));
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " s";
  }
  const auto whole = static_cast<long long>(std::min(std::round(s), 1e15));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) {
    return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  }
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

std::string final_parts_text(std::uint32_t final_parts, std::uint32_t parts) {
  return std::to_string(final_parts) + " of " + std::to_string(parts) +
         " parts of the picture are final";
}

std::string end_checks_text(std::uint32_t rounds) {
  return std::to_string(rounds) + (rounds == 1 ? " check" : " checks") + " whether all is done";
}

std::string progress_text(const control::Progress& p) {
  std::string text(to_string(p.state));
  if (is_rendering(p)) text += " " + percent(p.fraction);
  return text + details(p);
}

std::string progress_bar(const control::Progress& p, std::size_t columns) {
  const double fraction = is_rendering(p) ? std::clamp(p.fraction, 0.0, 1.0) : 0.0;
  const std::string tail =
      is_rendering(p) ? percent(fraction) + short_details(p) : std::string(to_string(p.state));
  // The bar's length is fixed, lest it jump about as the text behind it grows.
  const std::size_t length = std::clamp(columns / 4, kMinBar, kMaxBar);
  const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(length));
  std::string line =
      "[" + std::string(filled, '#') + std::string(length - filled, '-') + "] " + tail;
  // A full line would wrap, and could not be redrawn.
  line.resize(std::min(line.size(), columns == 0 ? 0 : columns - 1));
  return line;
}

ProgressDisplay::ProgressDisplay(std::FILE* stream, bool is_quiet, bool as_json)
    : stream_(stream),
      is_quiet_(is_quiet),
      as_json_(as_json),
      is_terminal_(!as_json && ::isatty(::fileno(stream)) == 1),
      line_(stream) {}

void ProgressDisplay::show(const control::Progress& p) {
  if (is_quiet_) return;
  const auto now = Clock::now();
  const bool changed = !shown_ || shown_->state != p.state || shown_->rounds != p.rounds;
  const auto interval = is_terminal_ ? Clock::duration(kRedrawInterval) : kLineInterval;
  if (!changed && now - shown_at_ < interval) return;
  if (!is_terminal_ && shown_ && *shown_ == p) return;
  shown_ = p;
  shown_at_ = now;
  if (is_terminal_) return line_.draw(progress_bar(p, terminal_columns(stream_)));
  std::fputs(((as_json_ ? encode(p) : progress_text(p)) + "\n").c_str(), stream_);
  std::fflush(stream_);
}

}  // namespace graycube
