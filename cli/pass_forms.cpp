#include "cli/pass_forms.h"

#include "core/base/error.h"

namespace hybridrt::cli {

ChosenForms choose_forms(const RenderOptions& o, const RenderSettings& settings) {
  ChosenForms chosen{PassForms::gl, o.gl, ""};
  const bool asks_device = !o.gl.device.empty() || o.gl.require_hardware;
  const bool asks_gl = asks_device || !o.shaders.empty();
  if (o.gl_use == GlUse::off && asks_device)
    throw error(ErrorKind::usage, "--gl off uses no GL device, but {} asks for one",
                o.gl.device.empty() ? "--require-hardware" : "--device");
  if (!uses_gl(settings)) return chosen;
  if (o.gl_use == GlUse::egl) chosen.gl.binding = gl::Binding::egl;
  if (o.gl_use == GlUse::osmesa) chosen.gl.binding = gl::Binding::osmesa;
  if (o.gl_use == GlUse::off) chosen.forms = PassForms::cpu;
  if (o.gl_use != GlUse::automatic || asks_gl) return chosen;

  if (gl::lists_hardware()) return chosen;
  chosen.forms = PassForms::cpu;
  chosen.reason = "no GPU; --gl egl draws passes 1, 2, 3 and 5 on Mesa";
  return chosen;
}

}  // namespace hybridrt::cli
