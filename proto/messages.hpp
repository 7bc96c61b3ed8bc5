// The control messages: what goes as JSON between nodes, frontal and clients, one struct per
// message. FORMAT.md, "Control messages", is normative. `kType` is the message's name on the wire,
// the members' names are the fields' names (control_fields.hpp lists them with their limits). Times
// are in seconds; jobs count from 1.
#pragma once

#include <variant>

#include "proto/messages/clients.hpp"
#include "proto/messages/farm_figures.hpp"
#include "proto/messages/from_nodes.hpp"
#include "proto/messages/hosts.hpp"
#include "proto/messages/sliding.hpp"
#include "proto/messages/to_nodes.hpp"
#include "proto/messages/values.hpp"

namespace graycube {

using ControlMessage = std::variant<
    control::Hello, control::Ready, control::EpochAck, control::TokenRound, control::Terminated,
    control::NodeReport, control::Pong, control::NodeError, control::WaitReport, control::Borrow,
    control::Share, control::Goodbye, control::Welcome, control::Load, control::Lend, control::Copy,
    control::HandOn, control::Relieved, control::AllWhole, control::Prepare, control::Start,
    control::Finish, control::Ping, control::Shutdown, control::Submit, control::Status,
    control::List, control::Watch, control::Cancel, control::Nodes, control::Fetch, control::Write,
    control::Down, control::Farm, control::Accepted, control::JobInfo, control::Jobs,
    control::Progress, control::NodeList, control::FarmInfo, control::Done, control::Picture,
    control::Written, control::Failed, control::Bye, control::Slide, control::Slid, control::Turn,
    control::Dealt, control::Worked, control::Host, control::Metrics, control::FarmMetrics,
    control::Log, control::LogLines, control::Join, control::Joined, control::RunNodes,
    control::EndNode, control::NodeEnded, control::Alive, control::Leave>;

}  // namespace graycube
