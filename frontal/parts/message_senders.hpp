// Who sends which control message: the compiler finds a message that no sender was given.
#pragma once

#include <concepts>

#include "proto/messages.hpp"

namespace graycube {

template <typename M, typename... Of>
concept OneOf = (std::same_as<M, Of> || ...);

/// From a node, once it has said hello.
template <typename M>
concept FromNode =
    OneOf<M, control::Ready, control::EpochAck, control::TokenRound, control::Terminated,
          control::NodeReport, control::Pong, control::NodeError, control::WaitReport,
          control::Borrow, control::Share, control::Goodbye, control::Slid, control::Worked>;

template <typename M>
concept FromClient = OneOf<M, control::Submit, control::Status, control::List, control::Watch,
                           control::Cancel, control::Nodes, control::Fetch, control::Write,
                           control::Farm, control::Metrics, control::Log, control::Down>;

/// From a host that runs nodes.
template <typename M>
concept FromHost = OneOf<M, control::Join, control::NodeEnded, control::Alive, control::Leave>;

template <typename M>
concept FromFrontal =
    OneOf<M, control::Welcome, control::Load, control::Lend, control::Copy, control::HandOn,
          control::Relieved, control::AllWhole, control::Slide, control::Turn, control::Dealt,
          control::Prepare, control::Start, control::Finish, control::Ping, control::Host,
          control::Shutdown, control::Accepted, control::JobInfo, control::Jobs, control::Progress,
          control::NodeList, control::FarmInfo, control::FarmMetrics, control::LogLines,
          control::Done, control::Picture, control::Written, control::Failed, control::Bye,
          control::Joined, control::RunNodes, control::EndNode>;

}  // namespace graycube
