#include "subdivisions/arnaldi_cells.hpp"

namespace graycube {

ArnaldiCells::ArnaldiCells(const Model& model, Entry entry) : entry_(entry) {
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  halves_.reserve(2);
  halves_.emplace_back(model, CameraSpace(frame, CameraSpace::Direction::kForward));
  if (frame.projection == Projection::kPerspective) {
    halves_.emplace_back(model, CameraSpace(frame, CameraSpace::Direction::kBackward));
  }
}

std::size_t ArnaldiCells::cell_count() const {
  std::size_t count = 0;
  for (const Half& half : halves_) count += half.bsp.leaves().size();
  return count;
}

std::size_t ArnaldiCells::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Half& half : halves_) bytes += half.bsp.memory_bytes();
  return bytes;
}

}  // namespace graycube
