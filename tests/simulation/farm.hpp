// A farm in one process: the real brains of frontal and nodes on simulated links, from a seed. Each directed
// link is a FIFO with random delays; evaluators take random times; what happens next is drawn from the seed
// alone, so that a failing run replays exactly.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <queue>
#include <random>
#include <string>
#include <vector>

#include "frontal/frontal.hpp"
#include "node/node.hpp"
#include "proto/control.hpp"

namespace graycube::simulation {

struct FarmOptions {
  std::uint32_t nodes = 8;
  std::uint32_t threads = 1;
  std::uint64_t seed = 1;
  /// Seconds; delays are drawn up to these, some links and evaluators much slower than others.
  double link_delay_s = 1e-3;
  double work_s = 1e-3;
};

/// What a job came to, and what was seen on the way.
struct Outcome {
  bool ended = false;
  std::optional<control::Done> done;
  std::optional<control::Failed> failed;
  std::uint32_t rounds = 0;
  /// Broken promises, in words; empty when all held.
  std::vector<std::string> violations;
};

class Farm {
 public:
  explicit Farm(const FarmOptions& options);

  /// Renders a scene; the picture is then in store().
  Outcome render(const std::string& scene_text, const control::JobOptions& options);
  JobStore& store() { return *store_; }
  /// The node stops answering and its links go dead at that simulated time after the next render begins.
  void kill_node_at(Rank rank, double after_s) { kill_ = {rank, after_s}; }
  /// Lets everything under way arrive.
  void settle();

 private:
  using Event = std::function<void()>;
  struct Scheduled {
    double at_s;
    std::uint64_t order;
    std::shared_ptr<Event> event;
    bool operator<(const Scheduled& o) const {
      return at_s != o.at_s ? at_s > o.at_s : order > o.order;
    }
  };

  void schedule(double after_s, Event event);
  void schedule_at(double at_s, Event event);
  bool run_one();
  double random(double most) { return std::uniform_real_distribution<double>(0, most)(random_); }
  /// Delivery after what is already under way on the same link.
  void deliver(const std::string& link, Event event);

  void start(const Frontal::Spawn& spawn);
  void after_frontal();
  void after_node(Rank rank);
  void look_for_work(Rank rank);
  void kill(Rank rank);
  void on_client_message(const Message& message);
  void watch_batch(const Bytes& batch, int change);
  void check_quiet();

  FarmOptions options_;
  std::mt19937_64 random_;
  std::unique_ptr<JobStore> store_ = make_memory_store();
  std::unique_ptr<Frontal> frontal_;
  struct Process {
    std::unique_ptr<Node> node;
    std::uint32_t incarnation = 0;
    unsigned busy = 0;
    double slowness = 1;
  };
  std::vector<Process> processes_;
  std::priority_queue<Scheduled> events_;
  std::map<std::string, double> link_free_at_, link_slowness_;
  double now_s_ = 0;
  std::uint64_t order_ = 0;
  std::int64_t rays_under_way_ = 0;
  bool is_over_ = false;
  std::optional<std::pair<Rank, double>> kill_;
  Outcome outcome_;
};

}  // namespace graycube::simulation
