// The fields of the messages of sliding boundaries, as control_fields.hpp lists all others.
#pragma once

#include "proto/messages/field_limits.hpp"
#include "proto/messages/sliding.hpp"
#include "regions/macro_grid.hpp"

namespace graycube::control {

void each_field(auto& visit, Is<Slide> auto& m) {
  constexpr FieldLimits kEdges{.min = 1, .max = kMaxImageSide, .length = kMaxGridSide - 1};
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("generation", m.generation, at_least_one());
  visit("column_edges", m.column_edges, kEdges);
  visit("row_edges", m.row_edges, kEdges);
}

void each_field(auto& visit, Is<Slid> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("generation", m.generation, at_least_one());
  visit("build_s", m.build_s, kSeconds);
}

void each_field(auto& visit, Is<Turn> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("current", m.current);
  visit("oldest", m.oldest);
}

void each_field(auto& visit, Is<Worked> auto& m) {
  visit("job", m.job, at_least_one());
  visit("epoch", m.epoch);
  visit("work", m.work);
  visit("tiles", m.tiles);
}

}  // namespace graycube::control
