#include "simulation/farm.hpp"

#include <algorithm>

#include "proto/batch.hpp"

namespace graycube::simulation {
namespace {

const PeerId kClient = "client";
constexpr double kTick_s = 0.05;
/// A job that takes longer than this in simulated time has stalled.
constexpr double kStalled_s = 600;

PeerId peer_of(Rank rank, std::uint32_t incarnation) {
  return "node-" + std::to_string(rank.value) + "." + std::to_string(incarnation);
}

}  // namespace

Farm::Farm(const FarmOptions& options)
    : options_(options), random_(options.seed), processes_(options.nodes) {
  FrontalOptions f{.cube = *Hypercube::of_size(options.nodes),
                   .threads = options.threads,
                   .heartbeat_s = 1,
                   .silence_s = 1e9,
                   .version = "simulated"};
  frontal_ = std::make_unique<Frontal>(f, *store_);
  after_frontal();
}

void Farm::schedule(double after_s, Event event) { schedule_at(now_s_ + after_s, std::move(event)); }

void Farm::schedule_at(double at_s, Event event) {
  events_.push({at_s, order_++, std::make_shared<Event>(std::move(event))});
}

bool Farm::run_one() {
  if (events_.empty()) return false;
  const Scheduled next = events_.top();
  events_.pop();
  now_s_ = std::max(now_s_, next.at_s);
  frontal_->on_time(now_s_, now_s_);
  (*next.event)();
  return true;
}

void Farm::deliver(const std::string& link, Event event) {
  // One link in ten is a hundred times slower than the rest.
  const auto [slowness, is_new] = link_slowness_.try_emplace(link, 1);
  if (is_new && random(1) < 0.1) slowness->second = 100;
  double& free_at = link_free_at_[link];
  free_at = std::max(free_at, now_s_ + random(options_.link_delay_s) * slowness->second);
  schedule_at(free_at, std::move(event));
}

void Farm::start(const Frontal::Spawn& spawn) {
  Process& p = processes_[spawn.rank.value];
  NodeIdentity id{spawn.rank, spawn.incarnation, 1000 + spawn.incarnation,
                  "ipc:///simulated/" + std::to_string(spawn.rank.value), options_.threads,
                  "simulated"};
  p.node = std::make_unique<Node>(std::move(id));
  p.incarnation = spawn.incarnation;
  p.busy = 0;
  p.slowness = random(1) < 0.2 ? 20 : 1;
  const Message hello = p.node->hello();
  const PeerId peer = peer_of(spawn.rank, spawn.incarnation);
  deliver(peer + ">frontal", [this, peer, hello] {
    frontal_->on_message(peer, hello);
    after_frontal();
  });
}

void Farm::after_frontal() {
  for (const Frontal::Spawn& s : frontal_->take_spawns()) start(s);
  if (auto work = frontal_->take_work()) {
    PreparationResult result = run(*work);
    schedule(random(options_.work_s), [this, result] {
      frontal_->give_result(result);
      after_frontal();
    });
  }
  for (Frontal::Outgoing& o : frontal_->take_outgoing()) {
    if (o.to == kClient) {
      on_client_message(o.message);
      continue;
    }
    for (std::uint32_t r = 0; r < processes_.size(); ++r) {
      const std::uint32_t incarnation = processes_[r].incarnation;
      if (o.to != peer_of(Rank{r}, incarnation)) continue;
      deliver("frontal>" + o.to, [this, r, incarnation, message = std::move(o.message)] {
        if (processes_[r].incarnation != incarnation || !processes_[r].node) return;
        processes_[r].node->on_frontal(message);
        after_node(Rank{r});
      });
      break;
    }
  }
}

void Farm::after_node(Rank rank) {
  Process& p = processes_[rank.value];
  look_for_work(rank);
  for (Node::Outgoing& o : p.node->take_outgoing()) {
    const PeerId self = peer_of(rank, p.incarnation);
    if (!o.to) {
      if (const auto m = decode(o.message.text());
          std::holds_alternative<ControlMessage>(m) &&
          std::holds_alternative<control::Terminated>(std::get<ControlMessage>(m))) {
        is_over_ = true;
        check_quiet();
      }
      deliver(self + ">frontal", [this, self, message = std::move(o.message)] {
        frontal_->on_message(self, message);
        after_frontal();
      });
      continue;
    }
    watch_batch(o.message.frame, +1);
    deliver(self + ">" + std::to_string(o.to->value),
            [this, to = *o.to, message = std::move(o.message)] {
              watch_batch(message.frame, -1);
              if (!processes_[to.value].node) return;
              processes_[to.value].node->on_neighbour(message.frame);
              after_node(to);
            });
  }
}

void Farm::look_for_work(Rank rank) {
  Process& p = processes_[rank.value];
  while (p.busy < p.node->threads()) {
    auto work = p.node->take_work();
    if (!work) return;
    ++p.busy;
    auto result = std::make_shared<WorkResult>(Workbench{}.run(std::move(*work)));
    schedule(random(options_.work_s) * p.slowness,
             [this, rank, incarnation = p.incarnation, result] {
               Process& q = processes_[rank.value];
               if (q.incarnation != incarnation || !q.node) return;
               --q.busy;
               q.node->give_result(std::move(*result));
               after_node(rank);
             });
  }
}

void Farm::watch_batch(const Bytes& batch, int change) {
  const auto header = peek_header(batch);
  const auto* h = std::get_if<BatchHeader>(&header);
  if (h == nullptr || h->type != BatchType::kRays) return;
  rays_under_way_ += change;
  if (change > 0 && is_over_) outcome_.violations.push_back("rays were sent after the token's end");
}

/// The token has spoken: nothing may be left anywhere.
void Farm::check_quiet() {
  if (rays_under_way_ != 0) outcome_.violations.push_back("the token ended with rays under way");
  for (const Process& p : processes_) {
    if (p.busy != 0) outcome_.violations.push_back("the token ended with an evaluator at work");
    if (p.node && p.node->wait_reason() != WaitReason::kIdle) {
      outcome_.violations.push_back("the token ended with a node that has work");
    }
  }
}

void Farm::kill(Rank rank) {
  Process& p = processes_[rank.value];
  const std::uint32_t incarnation = p.incarnation;
  p.node.reset();
  frontal_->on_node_exit(rank, incarnation, "killed by signal 9");
  after_frontal();
}

void Farm::on_client_message(const Message& message) {
  const auto decoded = decode(message.text());
  const auto& m = std::get<ControlMessage>(decoded);
  if (const auto* accepted = std::get_if<control::Accepted>(&m)) {
    frontal_->on_message(kClient, Message::of_text(encode(control::Watch{accepted->job})));
    after_frontal();
  } else if (const auto* done = std::get_if<control::Done>(&m)) {
    outcome_.done = *done;
    outcome_.ended = true;
  } else if (const auto* failed = std::get_if<control::Failed>(&m)) {
    outcome_.failed = *failed;
    outcome_.ended = true;
  } else if (const auto* progress = std::get_if<control::Progress>(&m)) {
    outcome_.rounds = progress->rounds;
  }
}

Outcome Farm::render(const std::string& scene_text, const control::JobOptions& options) {
  outcome_ = {};
  is_over_ = false;
  const double began_s = now_s_;
  const auto text = std::as_bytes(std::span(scene_text.data(), scene_text.size()));
  frontal_->on_message(kClient, Message::of_text(encode(control::Submit{"simulated", options}),
                                                 Bytes(text.begin(), text.end())));
  after_frontal();
  if (kill_) {
    schedule(kill_->second, [this, rank = kill_->first] { kill(rank); });
    kill_.reset();
  }
  while (!outcome_.ended && now_s_ - began_s < kStalled_s) {
    if (!run_one()) now_s_ += kTick_s, frontal_->on_time(now_s_, now_s_);
    after_frontal();
  }
  if (!outcome_.ended) outcome_.violations.push_back("the job has stalled");
  return outcome_;
}

void Farm::settle() {
  while (!events_.empty()) run_one();
}

}  // namespace graycube::simulation
