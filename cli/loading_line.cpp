#include "cli/loading_line.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "cli/standard_streams.h"

namespace hybridrt::cli {
namespace {

constexpr std::chrono::milliseconds kPatience{1000}, kRedraw{100};

/// Draws on its own thread from construction to destruction. Throws std::system_error if none can be started.
class LoadingLine {
 public:
  LoadingLine(std::string scene, const LoadProgress& progress)
      : scene_(std::move(scene)), progress_(progress), thread_([this] { draw(); }) {}

  ~LoadingLine() {
    {
      std::lock_guard lock(mutex_);
      loaded_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }

 private:
  void draw() try {
    std::unique_lock lock(mutex_);
    bool drawn = false;
    for (auto wait = kPatience; !wake_.wait_for(lock, wait, [this] { return loaded_; }); wait = kRedraw) {
      say(fmt::format("\r{}\x1b[K", text()));
      drawn = true;
    }
    if (drawn) say("\r\x1b[K");
  } catch (...) {  // out of memory: the loader will report it; no exception may leave a thread
  }

  std::string text() const {
    const uint64_t bytes = progress_.bytes, read = std::min<uint64_t>(progress_.bytes_read, bytes);
    if (bytes == 0) return "loading " + scene_;
    return fmt::format("loading {} {} %", scene_, read * 100 / bytes);
  }

  const std::string scene_;
  const LoadProgress& progress_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool loaded_ = false;
  std::thread thread_;  // last, as it uses all other members
};

}  // namespace

RenderJob load_showing_progress(const RenderOptions& options, const SceneSource& source, ThreadPool& pool,
                                Warnings& warnings, bool quiet) {
  LoadProgress progress;
  std::optional<LoadingLine> line;
  if (!quiet && isatty(STDERR_FILENO)) {
    try {
      line.emplace(std::filesystem::path(source.argument).filename().string(), progress);
    } catch (const std::system_error&) {  // no thread: no line
    }
  }
  return make_render_job(options, source, pool, warnings, &progress);
}

}  // namespace hybridrt::cli
