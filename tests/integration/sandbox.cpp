#include "integration/sandbox.hpp"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>
#include <utility>

#include "catch.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr auto kPollInterval = 2ms;
constexpr const char* kMark = "GRAYCUBE_TEST_SANDBOX=";

/// Whether the sandbox sets a variable of the outer environment, on which no test must depend.
bool is_replaced(const std::string& variable) {
  for (const char* name : {"TMPDIR=", "XDG_RUNTIME_DIR=", "GRAYCUBE_FRONTAL=", kMark}) {
    if (variable.starts_with(name)) return true;
  }
  return false;
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> result;
  for (std::string& s : strings) result.push_back(s.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> names_below(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    names.push_back(fs::relative(entry.path(), folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

fs::path scene_file(const std::string& name) { return fs::path(GRAYCUBE_SCENES) / name; }

std::string file_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::optional<std::string> find_program(const std::string& name) {
  std::istringstream folders(::getenv("PATH") == nullptr ? "" : ::getenv("PATH"));
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string path = folder + "/" + name;
    if (::access(path.c_str(), X_OK) == 0) return path;
  }
  return std::nullopt;
}

// ---- Running

Running::Running(Running&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      wait_status_(other.wait_status_),
      out_(std::move(other.out_)),
      err_(std::move(other.err_)),
      started_(other.started_) {}

Running::~Running() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void Running::signal(int number) const {
  if (pid_ > 0) ::kill(pid_, number);
}

bool Running::has_ended() {
  if (pid_ > 0 && ::waitpid(pid_, &wait_status_, WNOHANG) == pid_) pid_ = -1;
  return pid_ < 0;
}

std::string Running::out() const { return file_bytes(out_); }
std::string Running::err() const { return file_bytes(err_); }

void Running::wait_for(const std::string& text, std::chrono::milliseconds limit) {
  const auto until = std::chrono::steady_clock::now() + limit;
  while ((out() + err()).find(text) == std::string::npos) {
    INFO("waiting for \"" << text << "\"; so far: " << out() << err());
    REQUIRE_FALSE(has_ended());
    REQUIRE(std::chrono::steady_clock::now() < until);
    std::this_thread::sleep_for(kPollInterval);
  }
}

Outcome Running::wait(std::chrono::milliseconds limit) {
  const auto until = std::chrono::steady_clock::now() + limit;
  while (!has_ended()) {
    INFO("it runs on: " << out() << err());
    REQUIRE(std::chrono::steady_clock::now() < until);
    std::this_thread::sleep_for(kPollInterval);
  }
  Outcome o;
  o.status = WIFEXITED(wait_status_) ? WEXITSTATUS(wait_status_) : 128 + WTERMSIG(wait_status_);
  o.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  o.out = out();
  o.err = err();
  return o;
}

// ---- Sandbox

Sandbox::Sandbox() {
  for (auto [member, name] :
       {std::pair{&work_, "w"}, {&temporary_, "t"}, {&runtime_, "r"}, {&logs_, "l"}}) {
    *member = root_ / name;
    fs::create_directory(*member);
  }
}

/// A farm whose command was killed goes on by itself.
Sandbox::~Sandbox() {
  try {
    for (const std::string& process : processes()) ::kill(std::stoi(process), SIGKILL);
  } catch (const fs::filesystem_error&) {
    // What was looked at has just ended.
  }
}

fs::path Sandbox::write(const std::string& name, const std::string& text) const {
  std::ofstream(work_ / name, std::ios::binary) << text;
  return work_ / name;
}

nlohmann::json Sandbox::json(const std::string& name) const {
  return nlohmann::json::parse(file_bytes(work_ / name));
}

Running Sandbox::start(const Arguments& arguments) {
  return start_program(GRAYCUBE_COMMAND, arguments);
}

Outcome Sandbox::run(const Arguments& arguments, std::chrono::milliseconds limit) {
  return start(arguments).wait(limit);
}

Outcome Sandbox::run_program(const std::string& path, const Arguments& arguments,
                             std::chrono::milliseconds limit) {
  return start_program(path, arguments).wait(limit);
}

Running Sandbox::start_program(const std::string& path, const Arguments& arguments) {
  std::vector<std::string> argv{path};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables{"TMPDIR=" + temporary_.string(),
                                     "XDG_RUNTIME_DIR=" + runtime_.string(),
                                     kMark + root_.path().string()};
  for (char** v = environ; *v != nullptr; ++v) {
    if (!is_replaced(*v)) variables.push_back(*v);
  }
  const auto argv_pointers = pointers(argv), environment = pointers(variables);
  Running running;
  const std::string number = std::to_string(started_++);
  running.out_ = logs_ / (number + ".out");
  running.err_ = logs_ / (number + ".err");
  running.started_ = std::chrono::steady_clock::now();
  const int out = ::open(running.out_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const int err = ::open(running.err_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  REQUIRE(out >= 0);
  REQUIRE(err >= 0);
  // Signals wait until the test framework's handlers are not the child's any more.
  sigset_t all, before;
  ::sigfillset(&all);
  ::sigprocmask(SIG_BLOCK, &all, &before);
  running.pid_ = ::fork();
  if (running.pid_ == 0) {
    ::setpgid(0, 0);
    // These signals have their usual effect, even if the test's own parent ignores them.
    for (const int s : {SIGINT, SIGTERM, SIGHUP}) ::signal(s, SIG_DFL);
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    ::dup2(::open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    if (::chdir(work_.c_str()) == 0)
      ::execve(path.c_str(), argv_pointers.data(), environment.data());
    ::_exit(127);
  }
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  ::close(out);
  ::close(err);
  REQUIRE(running.pid_ > 0);
  return running;
}

std::vector<std::string> Sandbox::processes() const {
  std::vector<std::string> found;
  const std::string mark = kMark + root_.path().string();
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (!std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c); })) {
      continue;
    }
    const std::string environment = file_bytes(entry.path() / "environ");
    if ((std::string(1, '\0') + environment).find('\0' + mark + '\0') == std::string::npos)
      continue;
    std::string command = file_bytes(entry.path() / "cmdline");
    std::replace(command.begin(), command.end(), '\0', ' ');
    found.push_back(name + " " + command);
  }
  return found;
}

std::vector<std::string> Sandbox::temporary_files() const {
  std::vector<std::string> names = names_below(temporary_);
  for (const std::string& name : names_below(runtime_)) names.push_back(name);
  return names;
}

std::vector<std::string> Sandbox::files() const { return names_below(work_); }

}  // namespace graycube
