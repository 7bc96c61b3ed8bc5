#include "process/process_state.hpp"

#include <fstream>
#include <iterator>
#include <string>

namespace graycube {

char process_state(long pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  // Behind the name in brackets, which may hold anything, stands the state.
  const std::size_t end_of_name = text.rfind(") ");
  return end_of_name + 2 < text.size() && end_of_name != text.npos ? text[end_of_name + 2] : '\0';
}

bool can_run(long pid) {
  const char state = process_state(pid);
  return state == 'R' || state == 'S' || state == 'D';
}

}  // namespace graycube
