#include "cli/options/listing.hpp"

#include "cli/option_values.hpp"

namespace graycube {
namespace {

constexpr std::uint32_t kMaxJobsShown = 1'000'000;

}  // namespace

void add_job_listing(Declaring& options, JobsCommand& jobs) {
  options.flag("--json", jobs.as_json, "As one line of JSON");
  options.option({.names = "--limit",
                  .value = "N",
                  .help = "At most so many (default " + std::to_string(jobs.limit) + ")"},
                 [&jobs](const std::string& text) {
                   jobs.limit = parse_count("--limit", text, 1, kMaxJobsShown);
                 });
  options.option({.names = "--skip", .value = "N", .help = "Without the first so many (default 0)"},
                 [&jobs](const std::string& text) {
                   jobs.skip = parse_count("--skip", text, 0, kMaxJobsShown);
                 });
}

void add_log_listing(Declaring& options, LogCommand& log) {
  options.flag("--follow,-f", log.follows, "Then print lines as they come, until the farm ends");
  options.option(
      {.names = "--lines",
       .value = "N",
       .help = "Begin with the newest so many, at most " + std::to_string(kMaxLinesKept) +
               " (default " + std::to_string(log.lines) + ")"},
      [&log](const std::string& text) {
        log.lines = parse_count("--lines", text, 0, kMaxLinesKept);
      });
  options.flag("--json", log.as_json, "Each as a line of JSON");
}

}  // namespace graycube
