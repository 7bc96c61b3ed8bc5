#include "formats/json/error_report.hpp"

#include <algorithm>
#include <utility>

namespace graycube {

void ErrorReport::add(JsonIndex where, std::string message) {
  if (has_room())
    found_.push_back({where, std::move(message)});
  else
    count();
}

std::vector<SceneError> ErrorReport::take(std::string_view text) {
  std::stable_sort(found_.begin(), found_.end(),
                   [](const Found& a, const Found& b) { return a.where < b.where; });
  std::vector<std::uint64_t> offsets;
  for (const auto& f : found_) offsets.push_back(tree_.offset(f.where));
  const auto positions = text_positions(text, offsets);
  std::vector<SceneError> errors;
  for (std::size_t i = 0; i < found_.size(); ++i)
    errors.push_back({tree_.pointer(found_[i].where), std::move(found_[i].message),
                      tree_.is_cbor() ? 0 : positions[i].line,
                      tree_.is_cbor() ? 0 : positions[i].column});
  if (not_kept_ > 0) errors.push_back({"", "and " + std::to_string(not_kept_) + " more errors"});
  found_.clear();
  return errors;
}

}  // namespace graycube
