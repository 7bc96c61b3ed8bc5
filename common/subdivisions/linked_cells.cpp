#include "subdivisions/linked_cells.hpp"

#include "subdivisions/walk.hpp"

namespace graycube {

std::optional<Crossing> LinkedCells::first_crossing(const Ray& ray, double t0, double t1,
                                                    Mailbox& mailbox) const {
  mailbox.begin_ray();
  return graycube::first_crossing(bsp_, ray, t0, t1, mailbox);
}

bool LinkedCells::pass_light(const Ray& ray, double t0, double t1, Mailbox& mailbox,
                             Rgb& light) const {
  mailbox.begin_ray();
  return graycube::pass_light(bsp_, ray, t0, t1, mailbox, light);
}

}  // namespace graycube
