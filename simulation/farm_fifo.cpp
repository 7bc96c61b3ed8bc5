// The processes that hold nodes' FIFOs on a simulated farm. Each shares its node's cores, and a
// message between the two costs either side what any message does, but takes no time on a link.
#include "simulation/farm.hpp"
#include "simulation/message_doings.hpp"

namespace graycube::simulation {

/// Starts or ends the process as the node's brain wants it, as the node's main thread does.
void Farm::serve_fifo(Process& p) {
  const std::optional<FifoOrder> order = p.node->fifo_order();
  if (order == p.fifo_order) return;
  p.fifo_order = order;
  p.fifo.reset();
  if (order) p.fifo.emplace(order->places);
}

void Farm::deliver_to_fifo(Rank rank, const FifoOrder& order, const std::vector<Bytes>& messages) {
  const std::uint32_t incarnation = processes_[rank.value].incarnation;
  for (const Bytes& m : messages) {
    timeline_.at(
        machine_.arrival_s(rank, rank, m.size(), timeline_.now_s()),
        [this, rank, incarnation, order, m] { fifo_receives(rank, incarnation, order, m); });
  }
}

void Farm::fifo_receives(Rank rank, std::uint32_t incarnation, const FifoOrder& order,
                         const Bytes& message) {
  auto answer = std::make_shared<Bytes>();
  const auto begin = [this, rank, incarnation, order, message, answer] {
    const bool is_served =
        is_alive(rank, incarnation) && processes_[rank.value].fifo_order == order;
    return is_served ? run_fifo(rank, message, *answer) : 0;
  };
  const auto end = [this, rank, incarnation, answer] {
    if (answer->empty()) return;
    timeline_.at(machine_.arrival_s(rank, rank, answer->size(), timeline_.now_s()),
                 [=, this] { node_receives_ray(rank, incarnation, *answer); });
  };
  fifos_[rank.value]->ask({cube_.nodes() + 1 + rank.value, begin, end});
}

/// Gives the FIFO a message; returns the seconds that it is busy with that and with its answer.
double Farm::run_fifo(Rank rank, const Bytes& message, Bytes& answer) {
  Process& p = processes_[rank.value];
  if (const auto wrong = p.fifo->take(message, answer))
    outcome_.violations.push_back("a FIFO ended: " + std::string(*wrong));
  PerUnit doings = handling(message.size());
  if (!answer.empty()) doings.add(handling(answer.size()));
  const double seconds = take(rank, doings);
  p.fifo_cpu_s += seconds;
  return seconds;
}

}  // namespace graycube::simulation
