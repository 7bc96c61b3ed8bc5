// The commands, one file each. They return the exit status, or throw a Failure.
#pragma once

#include "cli/command_line.hpp"
#include "cli/failure.hpp"

namespace graycube {

ExitStatus run(const RenderCommand& command);
ExitStatus run(const SubmitCommand& command);
ExitStatus run(const UpCommand& command);
ExitStatus run(const JoinCommand& command);
ExitStatus run(const JobsCommand& command);
ExitStatus run(const StatusCommand& command);
ExitStatus run(const WatchCommand& command);
ExitStatus run(const CancelCommand& command);
ExitStatus run(const FetchCommand& command);
ExitStatus run(const NodesCommand& command);
ExitStatus run(const LogCommand& command);
ExitStatus run(const DownCommand& command);
ExitStatus run(const KeyCommand& command);
ExitStatus run(const CheckCommand& command);
ExitStatus run(const CompareCommand& command);
ExitStatus run(const SimulateCommand& command);
ExitStatus run(const DrawCommand& command);
ExitStatus run(const ConvertCommand& command);
ExitStatus run(const PrintCommand& command);

}  // namespace graycube
