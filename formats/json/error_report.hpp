// Every error of a scene file, gathered while it is read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/json/scene_error.hpp"
#include "formats/json/tree.hpp"

namespace graycube {

class ErrorReport {
 public:
  explicit ErrorReport(const JsonTree& tree) : tree_(tree) {}

  void add(JsonIndex where, std::string message);
  /// Whether another message would be kept; if not, count() saves making it.
  bool has_room() const { return found_.size() < kMaxReportedErrors; }
  void count() { ++not_kept_; }
  /// Errors so far, kept or not.
  std::uint64_t total() const { return found_.size() + not_kept_; }
  bool empty() const { return found_.empty(); }
  /// The errors in the order of the text; if some were not kept, a last one tells how many.
  std::vector<SceneError> take(std::string_view text);

 private:
  struct Found {
    JsonIndex where;
    std::string message;
  };
  const JsonTree& tree_;
  std::vector<Found> found_;
  std::uint64_t not_kept_ = 0;
};

}  // namespace graycube
