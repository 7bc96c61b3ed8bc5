// The scene that is to be cut; it is subdivided when that is first asked for.
#pragma once

#include <memory>
#include <utility>

#include "trace/domain.hpp"

namespace graycube {

class WholeScene {
 public:
  explicit WholeScene(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

  const Model& model() const { return *model_; }
  const std::shared_ptr<const Model>& shared_model() const { return model_; }
  const std::shared_ptr<const Territory>& territory() const {
    if (!territory_) territory_ = Territory::of(model_);
    return territory_;
  }
  /// Whether the picture has at least so many primary rays to each primitive: subdividing the scene
  /// is then a small part of the work.
  bool has_primary_rays(std::uint64_t per_primitive) const {
    return model_->settings.image.primary_rays() >= per_primitive * model_->primitives.size();
  }

 private:
  std::shared_ptr<const Model> model_;
  mutable std::shared_ptr<const Territory> territory_;
};

}  // namespace graycube
