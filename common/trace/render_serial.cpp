#include "trace/render_serial.hpp"

#include <atomic>
#include <mutex>
#include <thread>

#include "check.hpp"
#include "process/clocks.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {
namespace {

class SerialRender {
 public:
  SerialRender(const Domain& domain, const SerialOptions& options, Film& film)
      : domain_(domain), options_(options), film_(film), plan_(domain.settings().image, {}) {}

  SerialResult run() {
    std::vector<std::thread> helpers;
    for (unsigned i = 1; i < options_.threads; ++i) helpers.emplace_back([this] { work(); });
    work();
    for (std::thread& t : helpers) t.join();
    result_.finished = !cancelled_;
    return result_;
  }

 private:
  void work() {
    Evaluator evaluator(domain_);
    Step step;
    SerialResult own;
    const double started = thread_cpu_seconds();
    for (;;) {
      const std::uint32_t i = next_.fetch_add(1);
      if (i >= plan_.tile_count() || cancelled_) break;
      if (options_.is_wanted && !options_.is_wanted(plan_.rect(i))) continue;
      step.clear();
      evaluator.trace_pixels(plan_.rect(i), step);
      // A pixel belongs to one tile and a tile to one thread: no lock.
      for (const PixelReturn& r : step.returns) film_.add(r.pixel, r.light);
      own.rays.add(step.rays);
      own.rounding.add(step.rounding);
      if (options_.tile_done) options_.tile_done(plan_.rect(i));
      report(i);
    }
    own.busy_s = thread_cpu_seconds() - started;
    const std::lock_guard lock(mutex_);
    result_.rays.add(own.rays);
    result_.rounding.add(own.rounding);
    result_.walk.add(evaluator.walk_counts());
    result_.busy_s += own.busy_s;
  }

  void report(std::uint32_t tile) {
    if (!options_.progress) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    const double share = static_cast<double>(tile + 1) / plan_.tile_count();
    if (!options_.progress(share)) cancelled_ = true;
  }

  const Domain& domain_;
  const SerialOptions& options_;
  Film& film_;
  TilePlan plan_;
  std::atomic<std::uint32_t> next_{0};
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  SerialResult result_;
};

}  // namespace

SerialResult render_serial(const Domain& domain, const SerialOptions& options, Film& film) {
  GRAYCUBE_CHECK(film.pixel_count() ==
                     std::uint64_t{domain.settings().image.width} * domain.settings().image.height,
                 "the film is not the picture's size");
  return SerialRender(domain, options, film).run();
}

}  // namespace graycube
