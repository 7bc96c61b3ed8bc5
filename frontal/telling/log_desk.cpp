#include "frontal/telling/log_desk.hpp"

#include <algorithm>
#include <utility>

namespace graycube {

void LogDesk::add(const FarmEvent& event) {
  if (lines_.size() >= kMaxLinesKept) lines_.pop_front();
  lines_.push_back({++last_number_, event.unix_s, event.job, event.is_trouble, event.text});
}

control::LogLines LogDesk::answer_to(const control::Log& request) const {
  const std::uint64_t after = request.pid == pid_ ? request.after : 0;
  const auto is_known = [&](const control::LogLine& line) { return line.number <= after; };
  auto first = std::ranges::find_if_not(lines_, is_known);
  const auto newer = static_cast<std::size_t>(lines_.end() - first);
  if (newer > request.newest) first += static_cast<std::ptrdiff_t>(newer - request.newest);
  const auto count =
      std::min<std::size_t>(kMaxLinesAnswered, static_cast<std::size_t>(lines_.end() - first));
  const bool are_all = first + static_cast<std::ptrdiff_t>(count) == lines_.end();
  return {pid_, is_end_ && are_all, {first, first + static_cast<std::ptrdiff_t>(count)}};
}

void LogDesk::ask(const PeerId& peer, const control::Log& request, double now_s, Post& post) {
  control::LogLines answer = answer_to(request);
  if (!answer.lines.empty() || answer.is_end || request.wait_s <= 0)
    return post.to_peer(peer, answer);
  if (waits_.size() >= kMaxLogWaits) {
    post.to_peer(waits_.front().peer, answer_to(waits_.front().request));
    waits_.pop_front();
  }
  waits_.push_back({peer, request, now_s + request.wait_s});
}

void LogDesk::answer_waits(double now_s, Post& post) {
  std::erase_if(waits_, [&](const Wait& wait) {
    control::LogLines answer = answer_to(wait.request);
    if (answer.lines.empty() && !answer.is_end && now_s < wait.until_s) return false;
    post.to_peer(wait.peer, answer);
    return true;
  });
}

}  // namespace graycube
