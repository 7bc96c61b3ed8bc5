// How the command reports that something went wrong, and the status with which it then ends.
#pragma once

#include <exception>
#include <string>
#include <vector>

namespace graycube {

/// The command's exit status (docs/manual.md, "Exit status").
enum class ExitStatus : int { kDone = 0, kFailed = 1, kBadInput = 2 };

/// One line on standard error: `graycube: WHAT: WHERE: WHY`. An empty part is left out.
struct Problem {
  std::string what, where, why;
  friend bool operator==(const Problem&, const Problem&) = default;
};

/// Ends the command; main prints the problems and nothing else.
class Failure : public std::exception {
 public:
  Failure(ExitStatus status, std::vector<Problem> problems)
      : status_(status), problems_(std::move(problems)) {}
  Failure(ExitStatus status, Problem problem)
      : Failure(status, std::vector<Problem>{std::move(problem)}) {}

  ExitStatus status() const { return status_; }
  const std::vector<Problem>& problems() const { return problems_; }
  /// The statistics file of a job that ended in a deadlock; else empty.
  const std::string& statistics() const { return statistics_; }
  /// Whether a job's nodes waited for each other in a circle.
  bool is_deadlock() const { return is_deadlock_; }
  /// Notes that a farm failed, and what it told about that.
  Failure& told_by_farm(bool is_deadlock, std::string statistics) {
    is_deadlock_ = is_deadlock;
    statistics_ = std::move(statistics);
    return *this;
  }
  const char* what() const noexcept override { return "the command failed"; }

 private:
  ExitStatus status_;
  std::vector<Problem> problems_;
  bool is_deadlock_ = false;
  std::string statistics_;
};

/// The failure for a command line without meaning: `graycube: usage: WHERE: WHY`, status 2.
Failure usage_failure(std::string where, std::string why);

/// The line of a problem, without its end; control characters become spaces, so that it stays one
/// line.
std::string line_of(const Problem& problem);

/// Prints the line on standard error.
void print(const Problem& problem);

}  // namespace graycube
