// Control messages of clients, and the frontal's answers to them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "proto/messages/values.hpp"

namespace graycube::control {

/// Followed by a binary frame: the scene's text.
struct Submit {
  static constexpr std::string_view kType = "submit";
  std::string scene_name{};
  JobOptions options{};
  /// Made by the client at random, or empty: a second submit under the same key is the same job, so
  /// that a client that had no answer can ask again.
  std::string key{};
  friend bool operator==(const Submit&, const Submit&) = default;
};

struct Status {
  static constexpr std::string_view kType = "status";
  std::uint32_t job = 0;
  friend bool operator==(const Status&, const Status&) = default;
};

struct List {
  static constexpr std::string_view kType = "list";
  friend bool operator==(const List&, const List&) = default;
};

/// Asks for progress from now on, until Done or Failed.
struct Watch {
  static constexpr std::string_view kType = "watch";
  std::uint32_t job = 0;
  friend bool operator==(const Watch&, const Watch&) = default;
};

struct Cancel {
  static constexpr std::string_view kType = "cancel";
  std::uint32_t job = 0;
  friend bool operator==(const Cancel&, const Cancel&) = default;
};

struct Nodes {
  static constexpr std::string_view kType = "nodes";
  friend bool operator==(const Nodes&, const Nodes&) = default;
};

/// Asks for rows of a picture. Fewer may come: then the client asks for the rest. Plane 0 is light,
/// planes 1 … kAovPlanes are those of AOVs.
struct Fetch {
  static constexpr std::string_view kType = "fetch";
  std::uint32_t job = 0, first_row = 0, rows = 0, plane = 0;
  friend bool operator==(const Fetch&, const Fetch&) = default;
};

/// Asks a private frontal to write a picture's files; a path may be "" for no file. The picture may
/// have at most kMostPixelsToWrite pixels.
struct Write {
  static constexpr std::string_view kType = "write";
  std::uint32_t job = 0;
  /// Absolute paths of the files.
  std::string exr{}, png{};
  friend bool operator==(const Write&, const Write&) = default;
};

/// Asks for the farm itself.
struct Farm {
  static constexpr std::string_view kType = "farm";
  friend bool operator==(const Farm&, const Farm&) = default;
};

/// Asks the frontal to stop the farm.
struct Down {
  static constexpr std::string_view kType = "down";
  friend bool operator==(const Down&, const Down&) = default;
};

// ---- The answers

struct Accepted {
  static constexpr std::string_view kType = "accepted";
  std::uint32_t job = 0;
  friend bool operator==(const Accepted&, const Accepted&) = default;
};

struct JobInfo {
  static constexpr std::string_view kType = "job_info";
  std::uint32_t job = 0;
  JobState state = JobState::kQueued;
  std::string scene{};
  Algorithm algorithm = Algorithm::kAuto;
  std::uint32_t nodes = 0;
  /// The part of the job that is done, 0 … 1.
  double fraction = 0;
  /// Seconds that are left; absent while nothing is known.
  std::optional<double> eta_s{};
  std::uint32_t rounds = 0;
  /// The times below are Unix time.
  double submitted_s = 0;
  std::optional<double> started_s{}, finished_s{};
  std::string message{};
  std::uint32_t tiles = 0, tiles_whole = 0;
  /// What was picked for the scene, as text for people; empty until then.
  std::string choices{};
  friend bool operator==(const JobInfo&, const JobInfo&) = default;
};

/// The newest kMaxJobsListed jobs.
struct Jobs {
  static constexpr std::string_view kType = "jobs";
  std::vector<JobInfo> jobs{};
  friend bool operator==(const Jobs&, const Jobs&) = default;
};

struct Progress {
  static constexpr std::string_view kType = "progress";
  std::uint32_t job = 0;
  JobState state = JobState::kQueued;
  double fraction = 0;
  std::optional<double> eta_s{};
  std::uint32_t tiles_whole = 0, tiles = 0, rounds = 0;
  std::optional<TokenProgress> token{};
  friend bool operator==(const Progress&, const Progress&) = default;
};

struct NodeList {
  static constexpr std::string_view kType = "node_list";
  std::vector<NodeInfo> nodes{};
  std::vector<HostInfo> hosts{};
  friend bool operator==(const NodeList&, const NodeList&) = default;
};

/// The farm: its frontal's process, and how much there is of what.
struct FarmInfo {
  static constexpr std::string_view kType = "farm_info";
  std::uint64_t pid = 0;
  /// Where the frontal listens for clients.
  std::string endpoint{};
  std::string version{};
  /// Unix time of the frontal's start.
  double started_s = 0;
  std::uint32_t nodes = 1, nodes_here = 0;
  /// Jobs that wait, that are on, and that have ended and are listed.
  std::uint32_t queued = 0, running = 0, ended = 0;
  friend bool operator==(const FarmInfo&, const FarmInfo&) = default;
};

struct Done {
  static constexpr std::string_view kType = "done";
  std::uint32_t job = 0;
  /// The statistics file, as its JSON text.
  RawObject stats{};
  friend bool operator==(const Done&, const Done&) = default;
};

/// A binary frame follows: `rows` rows of `width` pixels, see picture_rows.hpp.
struct Picture {
  static constexpr std::string_view kType = "picture";
  std::uint32_t job = 0, width = 1, height = 1, first_row = 0, rows = 0, plane = 0;
  /// Names of the AOVs that the picture has.
  std::string aov{};
  friend bool operator==(const Picture&, const Picture&) = default;
};

/// The files are written, each whole.
struct Written {
  static constexpr std::string_view kType = "written";
  std::uint32_t job = 0, width = 1, height = 1;
  /// CPU seconds that writing took the frontal, which the statistics can't have.
  double cpu_s = 0;
  friend bool operator==(const Written&, const Written&) = default;
};

/// A request was refused, or a job failed; job 0 if the request named none.
struct Failed {
  static constexpr std::string_view kType = "failed";
  std::uint32_t job = 0;
  FailureCode code = FailureCode::kFailed;
  std::vector<ErrorItem> errors{};
  /// The statistics file of a job that ended in a deadlock; absent for others.
  std::optional<RawObject> stats{};
  friend bool operator==(const Failed&, const Failed&) = default;
};

/// The frontal stops now.
struct Bye {
  static constexpr std::string_view kType = "bye";
  friend bool operator==(const Bye&, const Bye&) = default;
};

}  // namespace graycube::control
