#include "cli/pass_forms.h"

#include <utility>

#include "cli/job.h"
#include "core/base/error.h"
#include "core/base/start_thread.h"

namespace hybridrt::cli {

namespace {

constexpr const char* kNoGpu = "no GPU; --gl egl draws passes 1, 2, 3 and 5 on Mesa";

/// The device that the request means, or the Error(device) that tells why there is none.
std::string device_for(const RenderOptions& o, const gl::ContextRequest& request) {
  require_threads(thread_count(o) + 1);  // a software GL waits forever for those of its own that do not start
  const gl::ProbeResult& found = gl::probe_once(*o.probes, request, gl::ProbeScope::first);
  if (found.usable.empty()) throw gl::no_usable_context(request, found.failed);
  return found.usable.front().device;
}

/// A GPU if there is one that draws right, else the CPU.
ChosenForms choose_by_machine(const RenderOptions& o) {
  ChosenForms chosen{PassForms::cpu, o.gl, kNoGpu};
  if (!gl::may_have_gpu()) return chosen;
  gl::Probes untold;
  gl::Probes& probes = o.probes ? *o.probes : untold;
  const gl::ProbeResult& found = gl::probe_once(probes, o.gl, gl::ProbeScope::hardware);
  if (!found.usable.empty()) {
    chosen.forms = PassForms::gl, chosen.reason = "";
    chosen.gl.device = found.usable.front().device;
  } else if (!found.failed.empty()) {
    chosen.reason = fmt::format("{}: {}", found.failed.front().id, found.failed.front().problem);
    if (!std::exchange(probes.told, true))
      chosen.warning.emplace(
          WarningCode::gpu_unusable,
          fmt::format("the GPU cannot be used ({}); all passes run on the CPU; 'hybridrt doctor' tells more, "
                      "--gl off does not try",
                      chosen.reason));
  }
  return chosen;
}

}  // namespace

ChosenForms choose_forms(const RenderOptions& o, const RenderSettings& settings) {
  ChosenForms chosen{PassForms::gl, o.gl, ""};
  const bool asks_device = !o.gl.device.empty() || o.gl.require_hardware;
  const bool asks_gl = asks_device || !o.shaders.empty();
  if (o.gl_use == GlUse::off && asks_device)
    throw error(ErrorKind::usage, "--gl off uses no GL device, but {} asks for one",
                o.gl.device.empty() ? "--require-hardware" : "--device");
  if (!uses_gl(settings)) return chosen;
  if (o.gl_use == GlUse::automatic && !asks_gl) return choose_by_machine(o);
  if (o.gl_use == GlUse::egl) chosen.gl.binding = gl::Binding::egl;
  if (o.gl_use == GlUse::osmesa) chosen.gl.binding = gl::Binding::osmesa;
  if (o.gl_use == GlUse::off) chosen.forms = PassForms::cpu;
  if (chosen.forms == PassForms::gl && o.probes) chosen.gl.device = device_for(o, chosen.gl);
  return chosen;
}

}  // namespace hybridrt::cli
