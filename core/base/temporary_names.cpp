#include "core/base/temporary_names.h"

#include <array>
#include <atomic>
#include <climits>
#include <cstring>
#include <string>
#include <unistd.h>

namespace hybridrt {
namespace {

enum State { kFree, kBeingWritten, kFile, kFolder };

struct Slot {
  std::atomic<int> state{kFree};
  char path[PATH_MAX];
};

constexpr int kSlots = 64;
std::array<Slot, kSlots> slots;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler reads it");

}  // namespace

TemporaryName::TemporaryName(const std::filesystem::path& path, Kind kind) {
  const std::string& name = path.native();
  if (name.size() >= PATH_MAX) return;
  for (int i = 0; i < kSlots && slot_ < 0; ++i)
    if (int expected = kFree; slots[i].state.compare_exchange_strong(expected, kBeingWritten)) slot_ = i;
  if (slot_ < 0) return;
  std::memcpy(slots[slot_].path, name.c_str(), name.size() + 1);
  slots[slot_].state = kind == Kind::file ? kFile : kFolder;
}

TemporaryName::~TemporaryName() {
  if (slot_ >= 0) slots[slot_].state = kFree;
}

void remove_temporary_files() noexcept {
  for (const Slot& slot : slots)
    if (slot.state == kFile) ::unlink(slot.path);
  for (const Slot& slot : slots)
    if (slot.state == kFolder) ::rmdir(slot.path);
}

}  // namespace hybridrt
