#include "cli/run_inputs.h"

#include <chrono>
#include <ctime>
#include <filesystem>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/render/fingerprint.h"

namespace hybridrt::cli {
namespace {

using Json = nlohmann::ordered_json;

template <typename Vector>
Json numbers(const Vector& v) {
  return {v.x, v.y, v.z};
}

Json still(const Camera& camera) {
  return {{"eye", numbers(camera.eye_world)},
          {"target", numbers(camera.target_world)},
          {"up", numbers(camera.up)},
          {"fov_y_deg", camera.fov_y_rad * 180 / kPi}};
}

Json camera(const RenderOptions& options, const RenderJob& job) {
  Json result = {{"file", options.camera.empty() ? Json(nullptr) : Json(options.camera)}};
  const bool moves = !std::holds_alternative<Camera>(job.motion.course);
  result["moves"] = moves;
  result["first"] = still(camera_at(job.motion, job.frames.lowest()));
  if (moves) result["last"] = still(camera_at(job.motion, job.frames.highest()));
  return result;
}

Json lights(const RenderJob& job) {
  Json result = Json::array();
  for (const DirectionalLight& light : lights_at(job.lights, job.motion, job.frames.lowest()))
    result.push_back({{"type", "directional"},
                      {"toward", numbers(light.toward)},
                      {"color", numbers(light.color)},
                      {"shadow", light.casts_shadow}});
  return result;
}

std::string hex(uint64_t number) { return fmt::format("{:016x}", number); }

/// Equal for runs whose frames belong to one sequence, whichever frames each has, and whatever draws them: scene,
/// settings, and camera and lights here and there in it.
uint64_t sequence_fingerprint(uint64_t scene, const RenderJob& job) {
  const FrameRange& whole = job.motion.sequence;
  RenderSettings settings = job.settings;
  settings.forms = PassForms::cpu;
  constexpr int kPlaces = 8;
  for (int place = 0; place <= kPlaces; ++place) {
    const auto frame = whole.first + (int64_t{whole.last} - whole.first) * place / kPlaces;
    scene = fingerprint(scene, frame_request(job, static_cast<int>(frame)), settings);
  }
  return scene;
}

}  // namespace

Json run_inputs(const std::vector<std::string>& command_line, const RenderOptions& options, const RenderJob& job,
                const OutputPaths& paths, const std::vector<int>& frames) {
  const uint64_t scene = fingerprint(job.scene);
  Json fingerprints = Json::object();
  for (int frame : frames)
    fingerprints[std::to_string(frame)] = hex(fingerprint(scene, frame_request(job, frame), job.settings));
  const AmbientLight& ambient = job.settings.ambient;
  return {{"command_line", command_line},
          {"folder", std::filesystem::current_path().string()},
          {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
          {"up_axis", options.up_axis ? Json(name_in(kUpAxes, *options.up_axis)) : Json(nullptr)},
          {"camera", camera(options, job)},
          {"lights", lights(job)},
          {"ambient", {{"color", numbers(ambient.color)}, {"slope", numbers(ambient.slope)}}},
          {"background", numbers(job.settings.background)},
          {"alpha", job.settings.alpha},
          {"ground", options.ground},
          {"outputs",
           {{"pattern", paths.pattern.folder + paths.pattern.name},
            {"timings", paths.timings},
            {"part", paths.part.empty() ? Json(nullptr) : Json(paths.part)}}},
          {"scene_fingerprint", hex(scene)},
          {"sequence_fingerprint", hex(sequence_fingerprint(scene, job))},
          {"fingerprints", fingerprints}};
}

}  // namespace hybridrt::cli
