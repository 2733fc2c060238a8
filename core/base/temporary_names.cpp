#include "core/base/temporary_names.h"

#include <array>
#include <atomic>
#include <climits>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace hybridrt {
namespace {

enum State { kFree, kBeingWritten, kFile, kFolder, kLock };

struct Slot {
  std::atomic<int> state{kFree};
  int descriptor = -1;
  char path[PATH_MAX];
};

constexpr int kSlots = 64;
std::array<Slot, kSlots> slots;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler reads it");

/// Whether no other process holds a lock on the open file, or is about to look.
bool lock_all(int descriptor) {
  struct flock all {};
  all.l_type = F_WRLCK;
  all.l_whence = SEEK_SET;
  return ::fcntl(descriptor, F_OFD_SETLK, &all) == 0;
}

}  // namespace

TemporaryName::TemporaryName(const std::filesystem::path& path, Kind kind, int descriptor) {
  const std::string& name = path.native();
  if (name.size() >= PATH_MAX) return;
  for (int i = 0; i < kSlots && slot_ < 0; ++i)
    if (int expected = kFree; slots[i].state.compare_exchange_strong(expected, kBeingWritten)) slot_ = i;
  if (slot_ < 0) return;
  std::memcpy(slots[slot_].path, name.c_str(), name.size() + 1);
  slots[slot_].descriptor = descriptor;
  slots[slot_].state = kind == Kind::file ? kFile : kind == Kind::folder ? kFolder : kLock;
}

TemporaryName::~TemporaryName() {
  if (slot_ >= 0) slots[slot_].state = kFree;
}

void remove_temporary_files() noexcept {
  for (const Slot& slot : slots)
    if (slot.state == kFile) ::unlink(slot.path);
  for (const Slot& slot : slots)
    if (slot.state == kFolder) ::rmdir(slot.path);
  for (const Slot& slot : slots)
    if (slot.state == kLock && lock_all(slot.descriptor)) ::unlink(slot.path);
}

}  // namespace hybridrt
