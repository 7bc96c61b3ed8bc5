// graycube: the command.
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <variant>

#include "cli/commands/commands.hpp"
#include "cli/interrupts.hpp"
#include "geometry/simd.hpp"
#include "process/descriptors.hpp"
#include "scene/scene_fault.hpp"

namespace graycube {
namespace {

/// Standard output holds the answer of most commands: losing some of it is a failure.
ExitStatus flushed(ExitStatus status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  throw Failure(ExitStatus::kFailed, Problem{"output", "standard output", "can't be written to"});
}

ExitStatus run_command(int argc, char** argv) {
  if (const auto problem = choose_simd_from_environment()) {
    throw Failure(ExitStatus::kBadInput, Problem{"environment", "GRAYCUBE_SIMD", *problem});
  }
  raise_descriptor_limit();
  const Command command = parse_command_line(argc, argv);
  return flushed(std::visit([](const auto& c) { return run(c); }, command));
}

}  // namespace

ExitStatus run(const PrintCommand& command) {
  std::fputs(command.text.c_str(), stdout);
  return ExitStatus::kDone;
}

int guarded_main(int argc, char** argv) {
  ExitStatus status = ExitStatus::kFailed;
  try {
    status = run_command(argc, argv);
  } catch (const Failure& failure) {
    for (const Problem& problem : failure.problems()) print(problem);
    status = failure.status();
  } catch (const UnrenderableScene& scene) {
    for (const SceneFault& f : scene.faults()) print({"scene", f.pointer, f.message});
    status = ExitStatus::kBadInput;
  } catch (const std::bad_alloc&) {
    print({"memory", "this process", "there is not enough"});
  } catch (const std::exception& e) {
    print({"internal error", "this process", e.what()});
  }
  if (status == ExitStatus::kFailed && noted_interrupt() != 0) {
    std::fflush(stdout);
    die_of_interrupt();
  }
  return static_cast<int>(status);
}

}  // namespace graycube

int main(int argc, char** argv) { return graycube::guarded_main(argc, argv); }
