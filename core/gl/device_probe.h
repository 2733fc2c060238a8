#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/gl/context.h"

namespace hybridrt::gl {

/// The first argument of this program as a probing child (device_probe.h); it is no command.
inline constexpr const char* kProbeArgument = "--probe-gl";

enum class ProbeScope {
  first,     ///< the best context that the request allows
  hardware,  ///< the same, of the devices only that EGL itself lists as hardware
  all,       ///< every device that the request allows
};

struct ProbeResult {
  std::vector<ContextInfo> usable;
  std::vector<DeviceInfo> failed;  ///< what was tried before, with the reason
};

/// Opens contexts in a child process and makes each show that it draws right (self_check.h): a driver that crashes,
/// hangs (20 s) or draws wrong pictures is one that failed. Loads no GL into this process; the child is gone
/// afterwards. Throws Error(usage) when the system starts no process.
ProbeResult probe(const ContextRequest& request, ProbeScope scope);

/// main() of the child; `arguments`: those after kProbeArgument.
int answer_probe(const std::vector<std::string>& arguments);

/// What a run has found out, so that it tries each request once.
struct Probes {
  std::map<std::string, ProbeResult> known;
  bool told = false;  ///< the user knows that the GPU cannot be used
};

/// As probe(), unless it is known.
const ProbeResult& probe_once(Probes& probes, const ContextRequest& request, ProbeScope scope);

/// Whether this machine may have a GPU, by the devices that drivers' kernel modules make; or the environment names a
/// vendor's EGL. A moment's work: nothing is loaded.
bool may_have_gpu();

}  // namespace hybridrt::gl
