// Makes one function of several, for std::visit: the compiler reports a forgotten alternative.
#pragma once

namespace graycube {

template <typename... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <typename... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

}  // namespace graycube
