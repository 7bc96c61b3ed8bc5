#include "cli/failure.hpp"

#include <cstdio>

namespace graycube {

Failure usage_failure(std::string where, std::string why) {
  if (where.empty()) where = "command line";
  return {ExitStatus::kBadInput, Problem{"usage", std::move(where), std::move(why)}};
}

std::string line_of(const Problem& problem) {
  std::string line = "graycube";
  for (const std::string* part : {&problem.what, &problem.where, &problem.why}) {
    if (!part->empty()) line += ": " + *part;
  }
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return line;
}

void print(const Problem& problem) {
  const std::string line = line_of(problem) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace graycube
