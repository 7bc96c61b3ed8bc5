// What is wrong with a scene whose file keeps to the format: solids that can't be computed.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace graycube {

/// Faults beyond so many are only counted.
inline constexpr std::size_t kMaxSceneFaults = 100;

struct SceneFault {
  /// A JSON pointer (RFC 6901) to the leaf, light or setting in the scene as a file.
  std::string pointer;
  /// Names the solid, and its object where that has a name: an importer's objects are named after
  /// their places in the file.
  std::string message;
};

/// Gathers faults as they are found.
class SceneFaults {
 public:
  void add(std::string pointer, std::string message) {
    if (has_room())
      found_.push_back({std::move(pointer), std::move(message)});
    else
      count();
  }
  /// Whether another fault would be kept; if not, count() saves making its text.
  bool has_room() const { return found_.size() < kMaxSceneFaults; }
  void count() { ++not_kept_; }
  bool is_empty() const { return found_.empty(); }
  /// The faults in the order of the scene; if some were not kept, a last one tells how many.
  std::vector<SceneFault> take() && {
    if (not_kept_ > 0) found_.push_back({"", "and " + std::to_string(not_kept_) + " more"});
    return std::move(found_);
  }

 private:
  std::vector<SceneFault> found_;
  std::size_t not_kept_ = 0;
};

/// Thrown when a scene can't be compiled. There is at least one fault.
class UnrenderableScene : public std::runtime_error {
 public:
  explicit UnrenderableScene(std::vector<SceneFault> faults)
      : std::runtime_error(faults.front().pointer + ": " + faults.front().message),
        faults_(std::move(faults)) {}
  const std::vector<SceneFault>& faults() const { return faults_; }

 private:
  std::vector<SceneFault> faults_;
};

}  // namespace graycube
