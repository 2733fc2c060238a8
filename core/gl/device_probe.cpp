#include "core/gl/device_probe.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <unistd.h>

#include "core/base/child_process.h"
#include "core/base/error.h"
#include "core/base/named.h"
#include "core/gl/context_backends.h"
#include "core/gl/self_check.h"

namespace hybridrt::gl {
namespace {

constexpr std::chrono::seconds kLongestSilence{20};
constexpr size_t kMostBytes = 1 << 20;

constexpr Named<Binding> kBindings[] = {{"any", Binding::any}, {"egl", Binding::egl}, {"osmesa", Binding::osmesa}};
constexpr Named<ProbeScope> kScopes[] = {
    {"first", ProbeScope::first}, {"hardware", ProbeScope::hardware}, {"all", ProbeScope::all}};

// The child's answer: a line for each step, its fields separated by tabs.
//   try DEVICE
//   bad DEVICE REASON
//   good DEVICE BINDING VENDOR RENDERER VERSION SOFTWARE MAX_TEXTURE_PX MAX_BUFFER_TEXELS
using Fields = std::vector<std::string>;

std::string line_of(const Fields& fields) {
  std::string line;
  for (const std::string& field : fields) {
    if (!line.empty()) line += '\t';
    for (const char c : field) line += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return line + "\n";
}

Fields fields_of(const std::string& line) {
  Fields fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, '\t');) fields.push_back(field);
  return fields;
}

int number(const std::string& text) {
  int value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

ContextInfo info_of(const Fields& f) { return {f[1], f[2], f[3], f[4], f[5], f[6] == "1", number(f[7]), number(f[8])}; }

/// Takes the answers in; returns the device that was tried last, or nothing.
std::string read_answers(const std::string& output, ProbeResult& result) {
  std::string trying;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const Fields fields = fields_of(line);
    if (fields.size() == 2 && fields[0] == "try") trying = fields[1];
    if (fields.size() == 3 && fields[0] == "bad") result.failed.push_back({fields[1], fields[2]});
    if (fields.size() == 9 && fields[0] == "good") result.usable.push_back(info_of(fields));
  }
  return trying;
}

}  // namespace

ProbeResult probe(const ContextRequest& request, ProbeScope scope) {
  ProbeResult result;
  std::vector<std::string> arguments = {kProbeArgument, std::string(name_in(kBindings, request.binding)),
                                        request.device, request.require_hardware ? "hardware" : "any",
                                        std::string(name_in(kScopes, scope))};
  for (;;) {
    const ChildEnd end = run_this_program(arguments, kLongestSilence, kMostBytes);
    const std::string trying = read_answers(end.output, result);
    if (end.problem.empty()) return result;
    // It may have drawn right before: one that crashes when it is closed is of no use either.
    const auto is_same = [&](const auto& known) { return known == trying; };
    std::erase_if(result.usable, [&](const ContextInfo& info) { return is_same(info.device); });
    std::erase_if(result.failed, [&](const DeviceInfo& device) { return is_same(device.id); });
    result.failed.push_back({trying.empty() ? "egl" : trying, "its driver " + end.problem});
    if (!trying.empty()) {
      arguments.push_back(trying);  // not again
    } else if (request.binding == Binding::any && scope != ProbeScope::hardware && arguments[1] != "osmesa") {
      arguments[1] = name_in(kBindings, Binding::osmesa);  // EGL crashed while it listed its devices
    } else {
      return result;
    }
  }
}

int answer_probe(const std::vector<std::string>& arguments) {
  die_with_parent();
  // What drivers print is no answer.
  std::FILE* const answers = ::fdopen(::dup(STDOUT_FILENO), "w");
  if (arguments.size() < 4 || !answers || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return 2;
  const auto say = [&](const Fields& fields) {
    std::fputs(line_of(fields).c_str(), answers);
    std::fflush(answers);
  };
  const ContextRequest request{value_in(kBindings, arguments[0]).value_or(Binding::any), arguments[1],
                               arguments[2] == "hardware"};
  const ProbeScope scope = value_in(kScopes, arguments[3]).value_or(ProbeScope::first);
  const std::vector<std::string> not_again(arguments.begin() + 4, arguments.end());
  for (const DeviceInfo& device : list_devices(request)) {
    if (std::find(not_again.begin(), not_again.end(), device.id) != not_again.end()) continue;
    if (scope == ProbeScope::hardware && !device.listed_as_hardware) continue;
    say({"try", device.id});
    try {
      const std::unique_ptr<Context> context = open_device(device, request.require_hardware);
      require_right_answers(*context);
      const ContextInfo& info = context->info();
      say({"good", info.device, info.binding, info.vendor, info.renderer, info.version, info.software ? "1" : "0",
           std::to_string(info.max_texture_px), std::to_string(info.max_buffer_texels)});
      if (scope != ProbeScope::all) break;
    } catch (const Error& failure) {
      say({"bad", device.id, failure.what()});
    }
  }
  std::_Exit(0);  // drivers' own destructors may crash: what was to be known is known
}

const ProbeResult& probe_once(Probes& probes, const ContextRequest& request, ProbeScope scope) {
  const std::string key = fmt::format("{} {} {} {}", name_in(kBindings, request.binding), request.require_hardware,
                                      name_in(kScopes, scope), request.device);
  const auto known = probes.known.find(key);
  return known != probes.known.end() ? known->second : probes.known[key] = probe(request, scope);
}

bool may_have_gpu() {
  for (const char* name : {"__EGL_VENDOR_LIBRARY_FILENAMES", "__EGL_VENDOR_LIBRARY_DIRS"})
    if (std::getenv(name)) return true;
  std::error_code none;
  // Mesa's drivers; NVIDIA's; WSL's; Tegra, Mali, Adreno and PowerVR without Mesa.
  for (const char* name : {"/dev/dri", "/dev/nvidiactl", "/dev/dxg", "/dev/nvhost-ctrl", "/dev/nvmap", "/dev/mali0",
                           "/dev/kgsl-3d0", "/dev/pvr_sync"})
    if (std::filesystem::exists(name, none)) return true;
  return false;
}

}  // namespace hybridrt::gl
